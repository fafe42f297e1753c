"""Short cuts: each file names the readable function that it equals bit for bit, and the test that shows it."""

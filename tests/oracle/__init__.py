"""Independent answers: slow, plain, and free of the code under test."""

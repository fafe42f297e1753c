#!/bin/sh
# A cluster of the machines of a class room. All have the same version of softshadow, and this one reaches them by ssh.
# The scheduler runs here; each machine gets one worker process with one thread for each core.
set -eu
hosts="${1:?expected the names of the machines, in quotes}"
here="${2:-$(hostname)}"

dask scheduler --port 8786 --no-dashboard &
scheduler=$!
trap 'kill "$scheduler"' EXIT
for host in $hosts; do
  ssh "$host" 'dask worker tcp://'"$here"':8786 --nworkers "$(nproc)" --nthreads 1 --memory-limit auto' &
done
softshadow sweep sweep.toml --scheduler "tcp://$here:8786"

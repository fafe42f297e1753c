#!/usr/bin/env bash
# Records the C programs of this folder anew, and packs their traces into programs.tar.xz:  PYTHON=python ./record.sh
# Needs Debian's packages apitrace, gcc, freeglut3-dev, libegl-dev, libglu1-mesa-dev and xvfb.
set -eu
cd "$(dirname "$0")"
here=$PWD
work=/tmp/programs # a plain name: traces hold the path of the program
mkdir "$work"
trap 'rm -r "$work"' EXIT
cp -- *.c window.h "$work"
export LIBGL_ALWAYS_SOFTWARE=1
(
  cd "$work"
  for source in *.c; do
    program=${source%.c}
    gcc -O1 -o "$program" "$source" -lglut -lGLU -lGL -lEGL -lm
    api=gl
    if grep -q '^#include <EGL' "$source"; then api=egl; fi
    xvfb-run -a -s "-screen 0 320x240x24" apitrace trace --api "$api" -o "$program.trace" "./$program" >/dev/null 2>&1 ||
      echo "$program: exit code $?"
  done
)
"${PYTHON:-python}" pack.py "$here/programs.tar.xz" "$work"/*.trace

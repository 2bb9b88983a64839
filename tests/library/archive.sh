#!/usr/bin/env bash
# A build from an archive of the repository knows its commit. archive.sh SOURCE
set -euo pipefail
cd "$1"
if ! commit=$(git rev-parse HEAD 2> /dev/null); then
  echo "not a checkout of git: nothing to archive"
  exit 77  # skipped
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
git archive HEAD | tar x -C "$work"
cmake -DOUTPUT="$work/info.cpp" -DSOURCE="$work" -DVERSION=0 -DCOMPILER=c -DBUILD_TYPE=t -P cmake/build_info.cmake
grep "commit = \"${commit:0:12}\"" "$work/info.cpp"

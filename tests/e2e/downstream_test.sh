#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The eigengrasp authors
# Installs a build into a folder of its own, builds examples/downstream against it and runs that program, from
# a folder where nothing of the source tree is.
# usage: downstream_test.sh SOURCE_FOLDER BUILD_FOLDER
set -eu
source=$1
build=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
quietly() { "$@" >"$work/log" 2>&1 || { cat "$work/log"; echo "failed: $*"; exit 1; }; }

quietly cmake --install "$build" --prefix "$work/prefix"
cp -R "$source/examples/downstream" "$work/downstream"
cd "$work"
quietly cmake -S downstream -B build -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$work/prefix"
quietly cmake --build build
output=$(build/best_grasp)
echo "$output"
case $output in
  *"epsilon 0.0000"*) echo "the best grasp has no form closure"; exit 1 ;;
  *epsilon*) ;;
  *) echo "expected a grasp and its epsilon"; exit 1 ;;
esac
if [ -x prefix/bin/eigengrasp ]; then
  prefix/bin/eigengrasp --version
  prefix/bin/eigengrasp hand list
fi

#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The eigengrasp authors
# ./run on systems that it cannot mend: it must say which packages are needed, and install nothing.
# usage: run_test.sh SOURCE_FOLDER
set -eu
source=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/tree" "$work/bin"
cp -R "$source/run" "$source/scripts" "$work/tree/"
for tool in sh sed tr cat dirname mkdir tail env awk; do
  ln -s "$(command -v "$tool")" "$work/bin/$tool"
done
fake() { printf '#!/bin/sh\n%s\n' "$2" >"$work/bin/$1"; chmod +x "$work/bin/$1"; }
run() { status=0; output=$(PATH=$work/bin "$work/bin/sh" "$work/tree/run" "$@" 2>&1) || status=$?; }
fail() { printf '%s\nwhat it printed (exit code %s):\n%s\n' "$1" "$status" "$output" >&2; exit 1; }
expect() { case $output in *"$1"*) ;; *) fail "expected the words: $1" ;; esac; }

run build  # neither apt-get nor dpkg-query
[ "$status" -ne 0 ] || fail "a system without apt must be refused"
expect "not a Debian-like system"
expect libeigen3-dev

fake apt-get 'echo "apt-get $*" >>"${0%/*}/../apt-calls"'
fake dpkg-query 'case $* in *libembree-dev*) exit 1 ;; *) printf "ii " ;; esac'
fake id 'echo 1000'
run build  # one package missing, no rights
[ "$status" -ne 0 ] || fail "without root and sudo it cannot go on"
expect "apt-get install libembree-dev"
[ ! -e "$work/apt-calls" ] || fail "nothing may be installed"

fake id 'echo 0'
fake cmake 'exit 1'
run build  # as root: only the missing package is installed; then cmake fails
[ "$status" -ne 0 ] || fail "a failing cmake must be reported"
grep -q -- '--no-install-recommends install libembree-dev$' "$work/apt-calls" || fail "wrong apt-get calls"
expect "installing 1 packages"
expect "failed: cmake --preset release"

run nonsense
[ "$status" -ne 0 ] || fail "an unknown command must fail"
expect "no command 'nonsense'"
echo "run_test: ok"

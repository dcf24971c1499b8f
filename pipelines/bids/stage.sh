#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# One rule's work: a case up to a stage, and a mark that says that it is whole or why not.
#
#   stage.sh PROGRAM FOLDER THREADS STAGE [STAGE BEFORE]     STAGE scene: the scene alone; samples_K_of_N: a share of
#                                                            the samples, in a run of its own
#
# It ends with 0 when the case itself is at fault, so that the engine goes on with the others; the stages after it pass
# the fault on. A shell, as a cohort of small heads would feel an interpreter's start at each stage.
set -euo pipefail
program=$1 threads=$3 stage=$4 before=${5:-}
cd "$2"
mkdir -p marks logs
mark=marks/$stage

leave_mark() { # CODE SENTENCE
  printf '%s\n' "$begin" "${EPOCHREALTIME/,/.}" "$1" "$2" > "$mark.partial"
  mv "$mark.partial" "$mark"
  exit 0
}

leave_fault() { # CODE LOG
  local said
  said=$(grep -v '^[[:space:]]*$' "$2" | tail -n 1 | sed 's/^brainshift: //') || true
  [ "$1" -le 128 ] || said="$stage was killed by signal $(($1 - 128))"
  leave_mark "$1" "${said:-$stage ended with $1 without a word}"
}

begin=${EPOCHREALTIME/,/.} # some locales have a comma
if [ -n "$before" ]; then
  mapfile -t said < "marks/$before"
  [ "${said[2]}" = 0 ] || leave_mark "${said[2]}" "${said[3]}"
fi
# If this shell is killed, its program may go on: it inherits the lock, and whoever comes next waits for it.
exec 9> lock
flock 9
begin=${EPOCHREALTIME/,/.}
source ./case.sh # scene, files, options
if [ -z "$scene" ]; then
  scene=$PWD/scene.xml
  if [ ! scene.xml -nt case.sh ]; then
    "$program" --quiet scene --new "${files[@]}" > scene.partial 2> logs/scene.log \
      || leave_fault $? logs/scene.log
    mv scene.partial scene.xml
  fi
fi
[ "$stage" != scene ] || leave_mark 0 ''
run_until() { # STAGE FOLDER OPTION...
  code=0
  "$program" --quiet --threads "$threads" run "$scene" --out "$2" --until "$1" "${options[@]}" "${@:3}" \
    > "logs/$stage.log" 2>&1 || code=$?
}

if [[ $stage = samples_* ]]; then
  IFS=_ read -r _ share _ shares <<< "$stage"
  mkdir -p shares
  exec 9> "shares/$share.lock"
  flock 9
  run_until solve "$PWD/shares/$share" --set "uncertainty.shares=$shares" --set "uncertainty.share=$share"
  [ $code = 0 ] || leave_fault $code "logs/$stage.log"
  leave_mark 0 ''
fi
if [ -d shares ] && [[ $stage = solve || $stage = report ]]; then
  run_until discretise "$PWD/run" # the folder is the run's before anything is put into it
  if [ $code = 0 ]; then
    mkdir -p run/samples
    find shares -name 'sample_*.vtu' -path '*/samples/*' -exec mv -t run/samples {} \;
    rm -r shares
  fi
fi
run_until "$stage" "$PWD/run"
[ $code = 0 ] || leave_fault $code "logs/$stage.log"
leave_mark 0 ''

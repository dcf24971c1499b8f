#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Kills, signals, want of room and memory, inputs that change, two runs in one folder: what a small run of the phantom
# makes of them. After each the run must end with the right code and at most one sentence, leave nothing half-written,
# and, when it is started again undisturbed, give the same bytes as if nothing had been.
#
#   bash tests/faults/run.sh PROGRAM [--short]
#
# Without --short: 200 kills, 50 sizes of the disk. Disks are mounted where that is allowed, else files are limited
# alone. SEED=number repeats the random instants of a run; they are printed.
set -uo pipefail
program=$(realpath "$1")
kills=200 signals=(INT TERM HUP QUIT XCPU) each=10 sizes=50 changes=10
if [ "${2:-}" = --short ]; then
  kills=1 signals=(QUIT) each=1 sizes=1 changes=1
fi
SEED=${SEED:-$RANDOM}
RANDOM=$SEED
echo "seed $SEED"
export OMP_WAIT_POLICY=passive OMP_NUM_THREADS=2
scratch=$(mktemp -d)
trap 'umount "$scratch/disk" 2>/dev/null; rm -rf "$scratch"' EXIT
cd "$scratch" || exit 1
faults=0

fail() {
  echo "FAULT: $*"
  sed 's/^/    /' said
  faults=$((faults + 1))
}

command=("$program" run head/small.xml --quiet --until register --out)
start() { # FOLDER: runs until its end; the sentence goes to the file said
  "${command[@]}" "$1" 2>said
}

# Everything but the times and the memory that it took.
sums() {
  (cd "$1" && find segment discretise solve register -type f ! -name stage.json -print0 | sort -z | xargs -0 sha256sum)
}
same_as_undisturbed() { # WHAT FOLDER
  start "$2"
  local code=$?
  [ $code = 0 ] || { fail "$1: the run after it ends with $code"; return; }
  sums "$2" >sums
  cmp -s sums undisturbed || fail "$1: the run after it gives other bytes: $(diff sums undisturbed | grep -c '^<') files"
}
ends_well() { # WHAT CODE FOLDER EXPECTED...
  local what=$1 code=$2 folder=$3 expected
  shift 3
  for expected in "$@"; do
    [ "$code" = "$expected" ] && expected=ok && break
  done
  [ "$expected" = ok ] || fail "$what: code $code, expected one of: $*"
  [ "$(wc -l <said)" -le 1 ] || fail "$what: more than one line"
  # A signal that comes while the program is still being loaded ends it before it can speak, or write.
  [ "$code" = 0 ] || grep -q '^brainshift: ' said || { [ "$code" -gt 128 ] && [ ! -e "$folder" ]; } ||
    fail "$what: code $code without a sentence"
  local half
  half=$(find "$folder" -name '*.partial' -o -name '*.old' 2>/dev/null)
  [ -z "$half" ] || fail "$what: half-written: $half"
}

"$program" phantom --size 40 --spacing 6 --out head || exit 1
"$program" segment --quiet --labels head/labels.nii.gz --brain-labels 1 2 3 --edge-length 14 --out surface || exit 1
cat >head/small.xml <<'SCENE'
<scene version="1">
  <image t1="t1.nii.gz" surface="../surface/brain.vtp"/>
  <tissues><tissue label="1" material="brain"/></tissues>
  <load><craniotomy file="craniotomy.csv"/></load>
  <landmarks file="landmarks.mrk.json"/>
  <stage name="segment" edge_length="14"/>
  <stage name="discretise" nodes="150"/>
  <stage name="solve" basis="linear" points_per_cell="1" tolerance="0.5"/>
  <stage name="register" fade="30"/>
</scene>
SCENE
begin=$(date +%s%N)
start undisturbed.run || { fail "undisturbed"; exit 1; }
milliseconds=$((($(date +%s%N) - begin) / 1000000))
sums undisturbed.run >undisturbed
echo "undisturbed: $milliseconds ms, $(wc -l <undisturbed) files"

pause() { # a random part of a run
  sleep "$(awk -v t=$((RANDOM % 1000 * milliseconds / 1000)) 'BEGIN { printf "%.3f", t / 1000 }')"
}
in_background() { # FOLDER: as start, its process is $!
  "${command[@]}" "$1" 2>said &
}

echo "kill -9 at $kills instants"
for ((i = 0; i < kills; ++i)); do
  rm -rf out out.partial
  in_background out
  pause
  kill -9 $! 2>/dev/null
  wait $! 2>/dev/null
  same_as_undisturbed "kill $i" out
done

for name in "${signals[@]}"; do
  echo "SIG$name at $each instants"
  for ((i = 0; i < each; ++i)); do
    rm -rf out
    # A shell without job control makes its background processes ignore SIGINT and SIGQUIT.
    set -m
    in_background out
    set +m
    pause
    kill -s $name $! 2>/dev/null
    wait $! 2>/dev/null
    ends_well "SIG$name" $? out 0 $((128 + $(kill -l $name)))
    same_as_undisturbed "SIG$name" out
  done
done

limited() { # WHAT ULIMIT... : code 0 or 1, and then the same bytes
  local what="$*"
  rm -rf out
  (ulimit "$@" && start out)
  ends_well "ulimit $what" $? out 0 1
  same_as_undisturbed "ulimit $what" out
}
largest=$(find undisturbed.run -type f -printf '%k\n' | sort -n | tail -1)
echo "files limited to $sizes sizes below $largest kB"
for ((i = 1; i <= sizes; ++i)); do
  limited -f $((i * largest / (sizes + 1)))
done
if [ "${2:-}" != --short ]; then
  echo "few open files"
  for limit in 6 8 10 12 16 24; do
    limited -n $limit
  done
fi

mkdir disk
if mount -t tmpfs -o size=64k none disk 2>/dev/null; then
  whole=$(du -sk undisturbed.run | cut -f1)
  echo "disks of $sizes sizes below $whole kB"
  for ((i = 1; i <= sizes; ++i)); do
    mount -o remount,size=$((i * whole / (sizes + 1)))k none disk
    start disk/out
    ends_well "disk of $((i * whole / (sizes + 1))) kB" $? disk/out 0 1
    mount -o remount,size=$((4 * whole))k none disk
    same_as_undisturbed "disk of $((i * whole / (sizes + 1))) kB" disk/out
    rm -rf disk/out
  done
  umount disk
else
  echo "disks cannot be mounted here: not tried"
fi

echo "inputs that change"
cp head/craniotomy.csv load
head -60 load >other
for ((i = 0; i < changes; ++i)); do
  rm -rf out
  in_background out
  pause
  cp other head/craniotomy.csv
  sleep 0.1
  cp load head/craniotomy.csv
  wait $! 2>/dev/null
  ends_well "a changed load" $? out 0 2
  same_as_undisturbed "a changed load" out
done

echo "two runs in one folder"
rm -rf out
in_background out
first=$!
sleep 0.2
"${command[@]}" out 2>second
code=$?
wait $first
ends_well "the first of two runs" $? out 0
cp second said
ends_well "the second of two runs" $code out 0 1
same_as_undisturbed "two runs" out

echo "$faults faults"
[ $faults = 0 ]

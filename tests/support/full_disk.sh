#!/usr/bin/env bash
# full_disk.sh PROGRAM WORK SCENE: when a file cannot grow any more the run ends with exit code 4, says which file, and leaves
# nothing half-written under a final name. A limit on the size of files stands for the full disk: below that of a checkpoint,
# above that of the files MPI keeps in shared memory.
set -u
program=$1 work=$2 scene=$3
launch="mpirun --allow-run-as-root --oversubscribe --mca mpi_yield_when_idle 1 -n"
fail() { echo "FAILED: $*"; exit 1; }
for ranks in 1 2; do
  rm -rf "$work"
  said=$(ulimit -f 6000; $launch $ranks "$program" run "$scene" --out "$work" --steps 4 2>&1)
  code=$?
  [[ $code -eq 4 ]] || fail "exit code $code on $ranks ranks, expected 4: $said"
  grep -q "$work" <<<"$said" || fail "the message does not name the file: $said"
  half=$(find "$work" -name '*.h5' -size -20k)
  [[ -z $half ]] || fail "left behind: $half"
  left=$(find "$work" -name '*.tmp*' -o -name '*.part*')
  [[ -z $left ]] || fail "temporary files left behind: $left"
done
echo "a full disk is told: $(grep -m1 error <<<"$said")"

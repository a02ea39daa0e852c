#!/usr/bin/env bash
# truncated_checkpoint.sh PROGRAM WORK SCENE: a truncated checkpoint is named and the one before it is taken; when none is good
# the run ends with exit code 4 and says so, on one rank and on two.
set -u
program=$1 work=$2 scene=$3
launch="mpirun --allow-run-as-root --oversubscribe --mca mpi_yield_when_idle 1 -n"
rm -rf "$work"
fail() { echo "FAILED: $*"; exit 1; }
"$program" run "$scene" --out "$work" --steps 8 --set output.checkpoint_interval=1e-9 --quiet || fail "the run"
mapfile -t files < <(ls "$work"/checkpoints/step-*.h5 | sort)
[[ ${#files[@]} -eq 2 ]] || fail "expected 2 checkpoints, got ${#files[@]}"
truncate -s -1000 "${files[1]}"
cp -r "$work" "$work.copy"
said=$("$program" restart "$work.copy" --steps 10 2>&1) || fail "a restart from the older checkpoint: $said"
grep -q "${files[1]##*/}" <<<"$said" || fail "the truncated file is not named: $said"
truncate -s 3000 "${files[0]}"
for ranks in 1 2; do
  said=$($launch $ranks "$program" restart "$work" --steps 10 2>&1)
  code=$?
  [[ $code -eq 4 ]] || fail "exit code $code on $ranks ranks, expected 4: $said"
  grep -q "${files[0]##*/}" <<<"$said" || fail "the message does not name the file: $said"
done
rm -rf "$work.copy"
echo "truncated checkpoints are found: $(grep -m1 error <<<"$said")"

#!/usr/bin/env bash
# stop_by_signal.sh PROGRAM WORK SCENE: SIGTERM and --walltime stop a run with exit code 75 and a checkpoint; resumed, it ends
# with the bits of a run that was not stopped.
set -u
program=$1 work=$2 scene=$3
fail() { echo "FAILED: $*"; exit 1; }
digest() { sed -n 's/.*"state_digest": "\(.*\)".*/\1/p' "$1/summary.json"; }
rm -rf "$work" "$work.whole"
"$program" run "$scene" --out "$work.whole" --steps 60 --quiet || fail "the whole run"
"$program" run "$scene" --out "$work" --steps 60 --quiet &
id=$!
for _ in $(seq 600); do # until it takes steps, however slow the machine
  [[ -f $work/history.csv && $(wc -l <"$work/history.csv") -ge 2 ]] && break
  kill -0 $id 2>/dev/null || break
  sleep 0.1
done
kill -TERM $id 2>/dev/null
wait $id
code=$?
[[ $code -eq 75 || $code -eq 0 ]] || fail "exit code $code after SIGTERM, expected 75"
"$program" restart "$work" --steps 60 --quiet || fail "resuming after SIGTERM"
[[ $(digest "$work") == "$(digest "$work.whole")" ]] || fail "other bits after SIGTERM: $(digest "$work"), $(digest "$work.whole")"
rm -rf "$work"
"$program" run "$scene" --out "$work" --steps 60 --walltime 0.2s --quiet
code=$?
[[ $code -eq 75 ]] || fail "exit code $code after --walltime, expected 75"
"$program" run "$scene" --out "$work" --restart auto --steps 60 --quiet || fail "run --restart auto"
[[ $(digest "$work") == "$(digest "$work.whole")" ]] || fail "other bits after --walltime"
echo "stopped and resumed: $(digest "$work")"

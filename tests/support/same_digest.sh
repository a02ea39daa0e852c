#!/usr/bin/env bash
# same_digest.sh PROGRAM WORK STEPS SCENE [options of run]: the scene ends with the same state_digest on 1, 2, 3 and 4 ranks,
# and when it is stopped half way and restarted on another number of ranks; blocks of another size
# give the same bits too, and so do blocks that may not sleep. The census of fragments, the loads of bodies and, with
# blocks of the same size, the ledger by stages have the same bytes.
# With BREAKING=1 in the environment, links must have broken half way, and more of them at the end.
set -u
program=$1 work=$2 steps=$3 scene=$4
shift 4
launch="mpirun --allow-run-as-root --oversubscribe --mca mpi_yield_when_idle 1 -n"
rm -rf "$work"
mkdir -p "$work"
failed=0
broken() { sed -n 's/.*"links_broken": \([0-9]*\).*/\1/p' "$1/summary.json"; }
digest() { sed -n 's/.*"state_digest": "\(.*\)".*/\1/p' "$1/summary.json"; }
run() { # run RANKS NAME COMMAND...
  local ranks=$1 name=$2
  shift 2
  if ! $launch "$ranks" "$program" "$@" --quiet >"$work/$name.log" 2>&1; then
    echo "FAILED: $name"
    cat "$work/$name.log"
    exit 1
  fi
}
check() { # check NAME DIRECTORY
  local got
  got=$(digest "$2")
  printf '%-28s %s\n' "$1" "$got"
  if [[ -z $expected || $got != "$expected" ]]; then
    echo "FAILED: $1: expected $expected, got $got"
    failed=1
  fi
  # Tables, where there are some. A ledger by stages sums block by block.
  local tables="fragments body_loads stages" table
  [[ $1 == blocks* ]] && tables="fragments body_loads"
  for table in $tables; do
    if [[ -f $work/one/$table.csv ]] && ! cmp "$work/one/$table.csv" "$2/$table.csv"; then
      echo "FAILED: $1: another $table.csv"
      failed=1
    fi
  done
}
run 1 one run "$scene" --out "$work/one" --steps "$steps" "$@"
expected=$(digest "$work/one")
check "1 rank" "$work/one"
for n in 2 3 4; do
  run $n ranks$n run "$scene" --out "$work/ranks$n" --steps "$steps" "$@"
  check "$n ranks" "$work/ranks$n"
done
if grep -q '^\[fluid\]' "$scene"; then
  run 2 blocks run "$scene" --out "$work/blocks" --steps "$steps" "$@" --set fluid.block=17
  check "blocks of 17 cells" "$work/blocks"
  run 2 awake run "$scene" --out "$work/awake" --steps "$steps" "$@" --set fluid.sleep=false
  check "no block sleeps" "$work/awake"
fi
if grep -q '^\[solid\]' "$scene"; then
  run 2 solid-awake run "$scene" --out "$work/solid-awake" --steps "$steps" "$@" --set solid.sleep=false
  check "no part of a solid sleeps" "$work/solid-awake"
fi
half=$((steps / 2))
for pair in "1 3" "2 1" "4 2"; do
  read -r before after <<<"$pair"
  name=restart${before}to$after
  run "$before" "$name-a" run "$scene" --out "$work/$name" --steps "$half" "$@"
  broken_half=$(broken "$work/$name")
  run "$after" "$name-b" restart "$work/$name" --steps "$steps"
  check "restart $before -> $after ranks" "$work/$name"
  if [[ ${BREAKING:-0} == 1 ]] && ! ((0 < broken_half && broken_half < $(broken "$work/$name"))); then
    echo "FAILED: $broken_half links are broken at the restart, $(broken "$work/$name") at the end: not in mid-fracture"
    failed=1
  fi
done
exit $failed

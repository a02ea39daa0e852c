#!/usr/bin/env bash
# same_gauges.sh PROGRAM WORK STEPS SCENE [options of run]: the gauges of the scene have the same bytes on 1, 2, 3 and 4 ranks,
# in blocks of another size, and when the run is stopped half way and restarted on another number of ranks, with rows beyond
# the checkpoint and a torn last line in the files. So have the output fields; and neither changes the state.
set -u
program=$1 work=$2 steps=$3 scene=$4
shift 4
launch="mpirun --allow-run-as-root --oversubscribe --mca mpi_yield_when_idle 1 -n"
rm -rf "$work"
mkdir -p "$work"
failed=0
digest() { sed -n 's/.*"state_digest": "\(.*\)".*/\1/p' "$1/summary.json"; }
figures() { sed -n '/"gauges": {\|"solid_gauges": {/,/state_digest/p' "$1/summary.json"; }
fail() { # fail WHAT
  echo "FAILED: $1"
  failed=1
}
run() { # run RANKS NAME COMMAND...
  local ranks=$1 name=$2
  shift 2
  if ! $launch "$ranks" "$program" "$@" --quiet >"$work/$name.log" 2>&1; then
    echo "FAILED: $name"
    cat "$work/$name.log"
    exit 1
  fi
}
check() { # check DIRECTORY
  diff -r "$work/one/gauges" "$1/gauges" || fail "$1: its gauges differ"
  [[ -n $(figures "$1") && $(figures "$1") == "$(figures "$work/one")" ]] || fail "$1: the figures of its gauges differ"
  local file
  [[ -d $work/one/fields ]] && for file in "$work"/one/fields/*.h5; do
    cmp "$file" "$1/fields/${file##*/}" || fail "$1: its fields differ"
  done
}
run 1 one run "$scene" --out "$work/one" --steps "$steps" "$@"
[[ $(cat "$work"/one/gauges/*.csv | wc -l) -gt 20 ]] || fail "the gauges hold next to nothing"
run 1 none run "$scene" --out "$work/none" --steps "$steps" "$@" --set 'output.gauge=[]' --set 'output.solid_gauge=[]' --set 'output.fields=["density"]'
[[ -n $(digest "$work/none") && $(digest "$work/none") == $(digest "$work/one") ]] || fail "gauges or fields change the state"
[[ -e $work/none/gauges ]] && fail "a scene without gauges writes some"
for n in 2 3 4; do
  run $n ranks$n run "$scene" --out "$work/ranks$n" --steps "$steps" "$@"
  check "$work/ranks$n"
done
if grep -q '^\[fluid\]' "$scene"; then
  run 2 blocks run "$scene" --out "$work/blocks" --steps "$steps" "$@" --set fluid.block=17
  check "$work/blocks"
fi
half=$((steps / 2))
for pair in "1 3" "4 2"; do
  read -r before after <<<"$pair"
  name=restart${before}to$after
  run "$before" "$name-a" run "$scene" --out "$work/$name" --steps "$half" "$@"
  for file in "$work/$name"/gauges/*.csv; do # as if it had been killed later
    tail -n +2 "$work/one/gauges/${file##*/}" | tail -n +"$(wc -l <"$file")" | head -3 >>"$file"
    printf '0.1,3' >>"$file"
  done
  run "$after" "$name-b" restart "$work/$name" --steps "$steps"
  check "$work/$name"
done
exit $failed

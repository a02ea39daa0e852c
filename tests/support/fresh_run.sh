#!/usr/bin/env bash
# fresh_run.sh PROGRAM WORK SCENE: a run that starts anew in the directory of a longer one leaves none of its checkpoints, and
# a restart leaves the scene as it was asked.
set -u
program=$1 work=$2 scene=$3
rm -rf "$work"
"$program" run "$scene" --out "$work" --steps 8 --quiet || exit 1
"$program" run "$scene" --out "$work" --steps 4 --quiet || exit 1
"$program" restart "$work" --steps 6 --quiet || exit 1
kept=$(cd "$work/checkpoints" && echo *)
[[ $kept == "latest step-0000000004.h5 step-0000000006.h5" ]] || { echo "FAILED: kept $kept"; exit 1; }
cmp "$scene" "$work/scene.toml" || { echo "FAILED: scene.toml is not the scene that was asked"; exit 1; }

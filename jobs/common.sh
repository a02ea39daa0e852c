# shellcheck shell=bash
# What jobs/run and jobs/test share: packages, build, mpirun. Sourced by bash; `root` is the folder of the sources.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build/release

say() { printf '== %s\n' "$*"; }
fail() { printf 'error: %s\n' "$*" >&2; exit 1; }

# Installs the packages of cmake/debian-packages.txt that are missing; nothing, and no network, when none is.
install_missing() {
  if ! command -v dpkg-query >/dev/null; then
    say "not a Debian system: the packages of cmake/debian-packages.txt are taken as installed"
    return 0
  fi
  local missing=() package
  while read -r package; do
    [[ -z $package || $package == \#* ]] && continue
    dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
  done <"$root/cmake/debian-packages.txt"
  [[ ${#missing[@]} -eq 0 ]] && return 0
  local as_root=()
  if [[ $(id -u) -ne 0 ]]; then
    command -v sudo >/dev/null || fail "these packages are missing and there is no sudo to install them: ${missing[*]}"
    as_root=(sudo)
  fi
  say "installing ${missing[*]}"
  "${as_root[@]}" apt-get update -qq || fail "apt-get update failed"
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" \
    >/dev/null || fail "apt-get install failed"
}

# build_release TARGET...: configures once, builds what changed. Quiet unless it fails or there is much to do.
build_release() {
  if [[ ! -f $build/build.ninja ]]; then
    say "configuring $build"
    mkdir -p "$build"
    cmake -G Ninja -C "$root/cmake/presets/release.cmake" -S "$root" -B "$build" >"$build/configure.log" 2>&1 ||
      { cat "$build/configure.log" >&2; fail "cmake failed"; }
  fi
  say "building"
  cmake --build "$build" --target "$@" || fail "the build failed"
}

# Cores this process may use, without counting hardware threads twice: what mpirun takes as slots.
cores() {
  local physical allowed
  physical=$(lscpu -p=CORE,SOCKET 2>/dev/null | grep -v '^#' | sort -u | wc -l)
  allowed=$(nproc)
  if ((physical > 0 && physical < allowed)); then echo "$physical"; else echo "$allowed"; fi
}

# mpirun_options RANKS: sets the array mpi.
mpirun_options() {
  mpi=(mpirun -n "$1" --quiet)  # brisance says itself why it ended
  [[ $(id -u) -eq 0 ]] && mpi+=(--allow-run-as-root)
  (($1 > $(cores))) && mpi+=(--oversubscribe)
  (($1 >= $(cores))) && mpi+=(--mca mpi_yield_when_idle 1)
  return 0
}

# SPDX-FileCopyrightText: 2026 The vantage authors
# SPDX-License-Identifier: MIT

# What examples/run, tests/run, benchmarks/run and .ci/run share; to be sourced from bash.
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
jobs=${VANTAGE_JOBS:-$(nproc)}
script=$(cd "$(dirname "$0")" && pwd)/${0##*/}
script=${script#"$root"/}

packages="cmake ninja-build g++ libeigen3-dev libtbb-dev libembree-dev libqhull-dev libfcl-dev libccd-dev libnanoflann-dev
          libpng-dev zlib1g-dev libstb-dev libtinygltf-dev nlohmann-json3-dev libcli11-dev
          libgtest-dev libbenchmark-dev libopenblas-dev liboctomap-dev"

# Ends the script with one clear line.
fail() { # exit code, line
  printf '%s: %s\n' "$script" "$2" >&2
  exit "$1"
}

# Installs those of the packages that are missing.
need() { # packages...
  local missing=() package sudo=""
  for package in "$@"; do
    dpkg-query -W -f '${db:Status-Status}\n' "$package" 2>/dev/null | grep -qx installed || missing+=("$package")
  done
  [ ${#missing[@]} -gt 0 ] || return 0
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || fail 1 "please install, as root: apt-get install ${missing[*]}"
    sudo=sudo
  fi
  echo "Installing ${missing[*]}" >&2
  install_missing() { $sudo env DEBIAN_FRONTEND=noninteractive apt-get install -qq -y --no-install-recommends "${missing[@]}"; }
  # A fresh system has no package lists yet.
  install_missing >/dev/null 2>&1 || { $sudo apt-get update -qq && install_missing; } >&2 ||
    fail 1 "could not install: ${missing[*]}"
}

# Configures a preset and builds targets of it. Quiet unless something is to be done or goes wrong.
build() { # preset, targets..., then -D options
  local preset=$1 options=() targets=() argument log
  shift
  for argument in "$@"; do
    case $argument in -D*) options+=("$argument") ;; *) targets+=("$argument") ;; esac
  done
  if command -v ccache >/dev/null; then
    export CMAKE_CXX_COMPILER_LAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER-ccache} CCACHE_BASEDIR=${CCACHE_BASEDIR-$root}
  fi
  cd "$root"
  log=$(cmake --preset "$preset" "${options[@]}" 2>&1) || { printf '%s\n' "$log" >&2; fail 1 "cannot configure $preset"; }
  cmake --build "build/$preset" -j "$jobs" --target "${targets[@]}" >&2 || fail 1 "cannot build ${targets[*]}"
}

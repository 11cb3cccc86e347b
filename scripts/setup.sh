#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Windfall authors
# SPDX-License-Identifier: MIT OR Apache-2.0
#
# Sourced by the other scripts: finds what they need, on Debian and Ubuntu installs what is missing (unless --no-install
# is given), and builds the program. Needs Rust; everything else is checked here.

set -euo pipefail

windfall_root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$windfall_root"

install=yes
for argument in "$@"; do
  case $argument in
    --no-install) install=no ;;
    *) echo "usage: $0 [--no-install]" >&2; exit 2 ;;
  esac
done

say() { printf '%s\n' "$*" >&2; }

# grep reads to the end: one that left early would break the pipe, which pipefail takes for a failure.
has_library() { ldconfig -p 2>/dev/null | grep "$1" >/dev/null || compgen -G "/usr/lib*/$1*" >/dev/null || compgen -G "/usr/lib/*/$1*" >/dev/null; }

# Succeeds if there is a Vulkan driver: a loader, and a driver manifest for it to find.
has_vulkan() {
  has_library libvulkan.so.1 || return 1
  [ -n "${VK_DRIVER_FILES:-}${VK_ICD_FILENAMES:-}" ] && return 0
  for folder in /usr/share/vulkan/icd.d /etc/vulkan/icd.d /usr/local/share/vulkan/icd.d; do
    ls "$folder"/*.json >/dev/null 2>&1 && return 0
  done
  return 1
}

# need COMMAND_OR_CHECK WHAT PACKAGES...: notes packages to install if the check fails.
missing=()
need() {
  local check=$1 what=$2
  shift 2
  if ! eval "$check"; then
    say "missing: $what"
    missing+=("$@")
  fi
}

install_missing() {
  [ ${#missing[@]} -eq 0 ] && return 0
  if [ $install = no ]; then
    say "not installing (--no-install); packages: ${missing[*]}"
    exit 2
  fi
  if ! command -v apt-get >/dev/null; then
    say "install these (Debian names) with your system's package manager: ${missing[*]}"
    exit 2
  fi
  local sudo=
  [ "$(id -u)" = 0 ] || sudo=sudo
  say "installing: ${missing[*]}"
  $sudo apt-get update -qq
  DEBIAN_FRONTEND=noninteractive $sudo apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
}

# build_windfall CARGO_OPTIONS...: builds the program and sets `windfall` to where cargo put it, which CARGO_TARGET_DIR and
# cargo's configuration decide.
build_windfall() {
  windfall=$(cargo build --release --workspace --bin windfall "$@" --message-format=json-render-diagnostics |
    sed -n 's|.*"executable":"\([^"]*/windfall\)".*|\1|p' | tail -n 1)
  if [ ! -x "$windfall" ]; then
    say "cargo did not say where it put the program"
    exit 1
  fi
}

if ! command -v cargo >/dev/null; then
  say "missing: Rust (cargo); install it from https://rustup.rs"
  exit 2
fi
need 'command -v cc >/dev/null' 'a C linker' gcc libc6-dev
need has_vulkan 'a Vulkan driver (software will do)' mesa-vulkan-drivers libvulkan1

# EGL and the window system want a private folder for their sockets.
if [ -z "${XDG_RUNTIME_DIR:-}" ]; then
  XDG_RUNTIME_DIR=$(mktemp -d)
  chmod 700 "$XDG_RUNTIME_DIR"
  export XDG_RUNTIME_DIR
fi

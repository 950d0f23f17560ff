# Sourced by ./demo and ./check: what both need before they can start. Says what it does, one line
# a step; what the tools say goes to a log that is shown when something fails.

packages=(g++ cmake ninja-build ccache libeigen3-dev libboost-dev libssl-dev libtinyxml2-dev libbullet-dev
  libgtest-dev libgmock-dev libbenchmark-dev libcli11-dev libfmt-dev nlohmann-json3-dev graphviz
  libxml2-utils liblz4-dev libzstd-dev zlib1g-dev relacy-dev libconcurrentqueue-dev spin liblua5.4-dev cyclonedds-dev libfastrtps-dev
  cyclonedds-tools openssl dpkg-dev file pybind11-dev python3-dev python3-numpy python3-pytest)
# For the inspector's page; one that comes from elsewhere than Debian will do.
command -v npm >/dev/null && command -v node >/dev/null || packages+=(nodejs npm)

say() { printf '%s\n' "$*"; }
fail() { say "$(basename "$0"): FAILED: $*" >&2; exit 1; }

# Installs the packages that are missing, as root or with sudo.
install_packages() {
  local package missing=() as_root=()
  for package in "${packages[@]}"; do
    [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || missing+=("$package")
  done
  [ ${#missing[@]} -eq 0 ] && return
  command -v apt-get >/dev/null || fail "apt-get is not here; please install: ${missing[*]}"
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || fail "not root, and no sudo; please install: ${missing[*]}"
    say "sudo is needed to install packages with apt-get: ${missing[*]}"
    as_root=(sudo)
  fi
  say "installing ${missing[*]}"
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive sh -c \
    'apt-get update -q && apt-get install -q -y --no-install-recommends "$@"' sh "${missing[@]}" \
    >"$log" 2>&1 || { tail -n 20 "$log"; fail "apt-get could not install; the log is $log"; }
}

# Configures and builds preset $1, further arguments are targets. Sets $build to its tree.
build_preset() {
  local preset=$1
  shift
  build=$PWD-build/$preset
  if [ ! -f "$build/build.ninja" ] || [ CMakePresets.json -nt "$build/build.ninja" ]; then
    say "configuring $preset in $build"
    cmake --preset "$preset" >"$log" 2>&1 || { tail -n 30 "$log"; fail "cmake; the log is $log"; }
  fi
  say "building $preset"
  if [ -t 1 ]; then
    ninja -C "$build" "$@" || fail "the build"
  else
    ninja -C "$build" "$@" >"$log" 2>&1 || { tail -n 60 "$log"; fail "the build; the log is $log"; }
  fi
}

log=$(mktemp "${TMPDIR:-/tmp}/runnel.XXXXXX.log")
trap 'status=$?; [ "$status" -eq 0 ] && rm -f "$log"' EXIT

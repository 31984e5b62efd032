# shellcheck shell=bash
# What ./run and ./test share: the packages and the build. Sourced; prints to stderr only.

say() { printf '%s: %s\n' "${0##*/}" "$*" >&2; }

fail() {
  say "$1"
  [ -z "${2:-}" ] || printf '      Try: %s\n' "$2" >&2
  exit 1
}

# package_names FILE...: the names in these lists
package_names() { sed -e 's/#.*//' -e '/^[[:space:]]*$/d' "$@"; }

# missing_packages FILE...: those of the lists that are not installed
missing_packages() {
  local installed
  # shellcheck disable=SC2046
  installed=$(dpkg-query -W -f='${db:Status-Status} ${Package}\n' $(package_names "$@") 2>/dev/null |
    sed -n 's/^installed //p' || true)
  package_names "$@" | grep -vxF "${installed:-none}" || true
}

# install_packages LOG FILE...: installs what is missing of the lists, and only that
install_packages() {
  local log=$1 missing privileged=()
  shift
  if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    say "this is not Debian: taking the packages of ${*##*/} as installed"
    return
  fi
  missing=$(missing_packages "$@" | tr '\n' ' ')
  [ -n "$missing" ] || return 0
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null ||
      fail "these packages are missing and only root can install them: $missing" "apt-get install $missing"
    privileged=(sudo)
  fi
  say "installing $missing(once)"
  local install=("${privileged[@]}" env DEBIAN_FRONTEND=noninteractive
    apt-get install -y -q --no-install-recommends)
  # The package lists of a machine may be absent or old: refresh them only where installing fails.
  # shellcheck disable=SC2086
  "${install[@]}" $missing >"$log" 2>&1 </dev/null ||
    { "${privileged[@]}" apt-get update -q >>"$log" 2>&1 </dev/null &&
      "${install[@]}" $missing >>"$log" 2>&1 </dev/null; } ||
    { tail -n 20 "$log" >&2
      fail "these packages could not be installed: $missing(all of the output: $log)" \
        "a working network, or 'apt-get update && apt-get install $missing' by hand"; }
}

# node_is_usable: node 18 or later and npm are on the PATH, wherever they come from
node_is_usable() {
  command -v npm >/dev/null && command -v node >/dev/null &&
    node -e 'process.exit(Number(process.versions.node.split(".")[0]) >= 18 ? 0 : 1)'
}

# install_node_packages LOG FOLDER: what the folder's lock file names, where it has changed since the last time
install_node_packages() {
  local log=$1 folder=$2
  cmp -s "$folder/package-lock.json" "$folder/node_modules/.installed" && return 0
  say "installing the npm packages of $folder (once)"
  if node_is_usable && (cd "$folder" && npm ci --no-audit --no-fund) >"$log" 2>&1 </dev/null; then
    cp "$folder/package-lock.json" "$folder/node_modules/.installed"
  else
    say "they could not be installed: the tests report_page and report_bundle are skipped (why: $log)"
  fi
}

# parallel_jobs: one a processor, as long as each compiler finds 1.5 GB of memory
parallel_jobs() {
  local processors fitting
  processors=$(nproc)
  fitting=$(awk '/^MemAvailable/ {print int($2 / 1.5e6)}' /proc/meminfo)
  [ "$fitting" -ge 1 ] || fitting=1
  [ "$fitting" -lt "$processors" ] && echo "$fitting" || echo "$processors"
}

# show_progress: passes nothing on but how far ninja is, on one line of a terminal
show_progress() {
  local line announced=
  while IFS= read -r line; do
    case $line in
    *"Re-checking globbed"*) ;; # nothing to build yet
    \[*/*\]*)
      if [ -t 2 ]; then
        printf '\r\033[K%.*s' "$((${COLUMNS:-80} - 1))" "building ${line}" >&2
      elif [ -z "$announced" ]; then
        say "building (the first time takes some minutes)"
      fi
      announced=yes
      ;;
    esac
  done
  [ -z "$announced" ] || [ ! -t 2 ] || printf '\r\033[K' >&2
}

# build PRESET TARGET [CMAKE OPTION...]: configures where needed and builds; the output goes to build/PRESET.log
build() {
  local preset=$1 target=$2 log=build/$1.log
  shift 2
  mkdir -p build
  # One build at a time in one tree.
  exec 9>"build/.$preset.lock"
  flock 9
  if [ ! -f "build/$preset/build.ninja" ] || [ $# -gt 0 ]; then
    local compiler_cache=()
    command -v ccache >/dev/null && compiler_cache=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
    cmake --preset "$preset" "${compiler_cache[@]}" "$@" >"$log" 2>&1 ||
      { tail -n 30 "$log" >&2; fail "configuring failed (all of the output: $PWD/$log)"; }
  fi
  cmake --build --preset "$preset" --target "$target" -j "$(parallel_jobs)" 2>&1 | tee "$log" | show_progress
  if [ "${PIPESTATUS[0]}" -ne 0 ]; then
    tail -n 40 "$log" >&2
    fail "building failed (all of the output: $PWD/$log)"
  fi
  exec 9>&-
}

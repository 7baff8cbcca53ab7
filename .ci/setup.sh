# Sourced by ./run and ./check: installs what packages.txt names and is missing, then configures and builds.
# Expects $root (the checkout); everything else is local to the functions.

say() { printf 'etalon: %s\n' "$*" >&2; }
die() { local code=$1; shift; printf 'etalon: error: %s\n' "$*" >&2; exit "$code"; }

# section_packages SECTION: one line a package, "required|optional <TAB> name|name… <TAB> reason".
section_packages() {
  awk -v want="[$1]" '
    /^[[:space:]]*(#|$)/ { next }
    /^\[/ { inside = ($1 == want); next }
    inside {
      reason = $0; if (!sub(/^[^#]*#[[:space:]]*/, "", reason)) reason = ""
      names = $0; sub(/#.*/, "", names)
      kind = sub(/^[[:space:]]*\?/, "", names) ? "optional" : "required"
      gsub(/[[:space:]]/, "", names)
      printf "%s\t%s\t%s\n", kind, names, reason
    }' "$root/packages.txt"
}

is_installed() { [ "$(dpkg-query -W -f '${db:Status-Status}\n' "$1" 2>/dev/null | head -n 1)" = installed ]; }

any_installed() {
  local name
  for name in ${1//|/ }; do is_installed "$name" && return 0; done
  return 1
}

# The first of name|name… that apt can install; fails when it knows none.
candidate_of() {
  local name
  for name in ${1//|/ }; do
    LC_ALL=C apt-cache policy "$name" 2>/dev/null | grep -q '^  Candidate: [^(]' && { echo "$name"; return 0; }
  done
  return 1
}

# Prints what an installation downloads and takes, by apt's simulation (`apt-get --assume-no` would install where it has no question to ask).
installation_size() {
  local names
  names=$(LC_ALL=C apt-get -s install --no-install-recommends "$@" 2>/dev/null | awk '/^Inst / { print $2 }')
  [ -n "$names" ] || { echo "size unknown"; return 0; }
  # shellcheck disable=SC2086 # a list of names
  LC_ALL=C apt-cache show --no-all-versions $names 2>/dev/null | awk '
    /^Package:/ { count++ }
    /^Size:/ { download += $2 }
    /^Installed-Size:/ { disk += $2 }
    END { printf "%d packages, %.1f MB to download, %.1f MB of disk\n", count, download / 1e6, disk * 1024 / 1e6 }'
}

# apt_get ARGUMENTS…: as root, or through sudo; waits up to five minutes for another apt to finish.
apt_get() {
  local as_root=()
  [ "$(id -u)" = 0 ] || as_root=(sudo)
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=300 -o Dpkg::Use-Pty=0 "$@" </dev/null
}

can_install() {
  [ "$(id -u)" = 0 ] && return 0
  command -v sudo >/dev/null 2>&1 || return 1
  sudo -n true 2>/dev/null && return 0
  [ -t 0 ] && sudo -v   # a person is there to type the password
}

# install_packages no|yes SECTION…: "no" forbids to install.
install_packages() {
  local allowed=$1 section kind names reason name i
  shift
  local required=() optional=() reasons=()
  if ! command -v dpkg-query >/dev/null 2>&1; then
    say "not a Debian system: expecting the libraries of packages.txt to be there"
    return 0
  fi
  for section in "$@"; do
    [ -n "$(section_packages "$section")" ] || die 4 "packages.txt has no section [$section]"
    while IFS=$'\t' read -r kind names reason; do
      any_installed "$names" && continue
      if [ "$kind" = required ]; then required+=("$names"); else optional+=("$names"); reasons+=("$reason"); fi
    done < <(section_packages "$section")
  done
  [ ${#required[@]} -eq 0 ] && [ ${#optional[@]} -eq 0 ] && return 0

  local first_names=("${required[@]%%|*}" "${optional[@]%%|*}")
  if [ "$allowed" = no ]; then
    for i in "${!optional[@]}"; do say "warning: ${optional[$i]} is not installed: ${reasons[$i]}"; done
    [ ${#required[@]} -eq 0 ] && return 0
    die 4 "--no-install: missing packages: ${required[*]}"
  fi
  if ! can_install; then
    if [ ${#required[@]} -eq 0 ]; then
      for i in "${!optional[@]}"; do say "warning: ${optional[$i]} is not installed and cannot be without root: ${reasons[$i]}"; done
      return 0
    fi
    say "packages are missing, and there is neither root nor sudo to install them. An administrator's one line:"
    printf '  apt-get update && apt-get install --no-install-recommends %s\n' "${first_names[*]}" >&2
    exit 4
  fi

  say "to install: ${first_names[*]}"
  mkdir -p "$root/build" || die 4 "$root/build: cannot be created"
  local log="$root/build/packages.log"
  apt_get -qq update >"$log" 2>&1 || say "warning: apt-get update failed ($(tail -n 1 "$log")); going on with the lists that are there"

  local resolved=()
  for names in "${required[@]}"; do
    name=$(candidate_of "$names") || die 4 "no package ${names//|/ or } here; packages.txt says what it is for"
    resolved+=("$name")
  done
  if [ ${#resolved[@]} -gt 0 ]; then
    say "installing with what they need: $(installation_size "${resolved[@]}")"
    apt_get install -y -q --no-install-recommends "${resolved[@]}" >>"$log" 2>&1 ||
      { tail -n 15 "$log" >&2; die 4 "apt-get install failed; the whole log is $log"; }
  fi
  for i in "${!optional[@]}"; do
    if name=$(candidate_of "${optional[$i]}"); then
      say "installing $name: $(installation_size "$name")"
      apt_get install -y -q --no-install-recommends "$name" >>"$log" 2>&1 && continue
    fi
    say "warning: ${optional[$i]} could not be installed: ${reasons[$i]}"
  done
}

# configure DIR OPTION…: only when DIR holds no build of this checkout or was made with other options; ninja re-configures by itself when a CMakeLists.txt changed.
configure() {
  local dir=$1 wanted
  shift
  wanted="$root $*"
  [ -f "$dir/build.ninja" ] && [ "$(cat "$dir/configured-with" 2>/dev/null)" = "$wanted" ] && return 0
  mkdir -p "$dir" || die 4 "$dir: cannot be created"
  local launcher=()
  command -v ccache >/dev/null 2>&1 && launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$dir/CMakeCache.txt" 2>/dev/null || rm -rf "$dir/CMakeCache.txt" "$dir/CMakeFiles"
  say "configuring ${dir#"$root"/}"
  cmake -S "$root" -B "$dir" -G Ninja "${launcher[@]}" "$@" >"$dir/configure.log" 2>&1 ||
    { tail -n 25 "$dir/configure.log" >&2; die 4 "cmake failed; the whole log is $dir/configure.log"; }
  printf '%s\n' "$wanted" >"$dir/configured-with"
}

# build DIR TARGET…: one moving line on a terminal, else a line every half minute.
build() {
  local dir=$1 pid log status
  shift
  if [ -t 2 ] && [ -t 1 ]; then
    NINJA_STATUS='building [%f/%t] ' ninja -C "$dir" "$@" >&2 || die 4 "the build failed"
    return 0
  fi
  log="$dir/build.log"
  NINJA_STATUS='[%f/%t] ' ninja -C "$dir" "$@" >"$log" 2>&1 &
  pid=$!
  trap 'kill "$pid" 2>/dev/null' EXIT
  local waited=0
  while kill -0 "$pid" 2>/dev/null; do
    sleep 0.2
    waited=$((waited + 1))
    [ $((waited % 150)) -eq 0 ] && say "building $(grep -o '^\[[0-9]*/[0-9]*\]' "$log" | tail -n 1)"
  done
  status=0
  wait "$pid" || status=$?
  trap - EXIT
  [ "$status" -eq 0 ] || { grep -v '^\[' "$log" | tail -n 40 >&2; die 4 "the build failed; the whole log is $log"; }
}

# The options of the one build/ that ./run and ./check share.
build_options() {
  case $1 in
    tests) echo "-DCMAKE_BUILD_TYPE=Release -DETALON_TESTS=ON -DETALON_BENCH=OFF" ;;
    bench) echo "-DCMAKE_BUILD_TYPE=Release -DETALON_TESTS=ON -DETALON_BENCH=ON" ;;
    no-tests) echo "-DCMAKE_BUILD_TYPE=Release -DETALON_TESTS=OFF" ;;
  esac
}

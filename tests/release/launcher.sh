#!/bin/sh
# launcher.sh LAUNCHER: with a program that prints its arguments, and systems that are made up.
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
root="$work/a folder"
mkdir -p "$root/bin" "$root/lib/vdbcage/libX11" "$work/system" "$work/tools" "$work/links"

# It needs glibc 2.35 and libstdc++.so.6.0.30; its own libstdc++ needs glibc 2.36.
sed -e 's/@GLIBC@/35/' -e 's/@GLIBC_OF_CXX@/36/' -e 's/@CXX@/30/' -e "s|^folders=.*|folders=$work/system|" "$1" \
    >"$root/bin/vdbcage-view"
printf '#!/bin/sh\nprintf "%%s\\n" "$@" "${LD_LIBRARY_PATH-none}"\nexit 7\n' >"$root/lib/vdbcage/vdbcage-view"
chmod +x "$root/bin/vdbcage-view" "$root/lib/vdbcage/vdbcage-view"
ln -s "$root/bin/vdbcage-view" "$work/links/cages"

# system MACHINE GLIBC LIBRARY...: of which the launcher is told.
system() {
    printf '#!/bin/sh\necho %s\n' "$1" >"$work/tools/uname"
    printf '#!/bin/sh\n%s\n' "$2" >"$work/tools/getconf"
    chmod +x "$work/tools/uname" "$work/tools/getconf"
    shift 2
    rm -f "$work/system"/*
    for library in "$@"; do
        touch "$work/system/$library"
    done
}

# starts STATUS LINE...: started through a link in PATH, it ends with this status and has printed these lines.
starts() {
    expected=$1
    shift
    printf '%s\n' "$@" >"$work/expected"
    status=0
    (PATH="$work/links:$work/tools:$PATH" && unset LD_LIBRARY_PATH && cages 'one word' --two) >"$work/printed" 2>&1 ||
        status=$?
    if [ "$status" != "$expected" ] || ! diff "$work/expected" "$work/printed"; then
        echo "status $status, not $expected" >&2
        exit 1
    fi
}

has_glibc() { echo "echo 'glibc $1'"; }

system x86_64 "$(has_glibc 2.36)" libstdc++.so.6.0.29 libstdc++.so.6.0.33 libX11.so.6
starts 7 'one word' --two none
system x86_64 "$(has_glibc 2.35)" libstdc++.so.6.0.30 libstdc++.so.6.0.30-gdb.py
starts 7 'one word' --two "$root/lib/vdbcage/libX11"
system x86_64 "$(has_glibc 2.36)"
starts 7 'one word' --two "$root/lib/vdbcage/libstdc++:$root/lib/vdbcage/libX11"
system x86_64 "$(has_glibc 3.0)" libstdc++.so.6.0.40 libX11.so.6
starts 7 'one word' --two none

old='vdbcage-view: error: these programs need glibc'
system x86_64 "$(has_glibc 2.34)" libstdc++.so.6.0.30 libX11.so.6
starts 75 "$old 2.35 or later; this system has 2.34"
system x86_64 "$(has_glibc 2.9)" libstdc++.so.6.0.30 libX11.so.6
starts 75 "$old 2.35 or later; this system has 2.9"
system x86_64 "$(has_glibc 2.35)" libstdc++.so.6.0.29 libX11.so.6
starts 75 "$old 2.36 or later; this system has 2.35"
system x86_64 'echo getconf: unknown >&2; exit 1'
starts 75 "$old 2.36 or later; this system has none"
system aarch64 "$(has_glibc 2.36)" libstdc++.so.6.0.30
starts 75 'vdbcage-view: error: these programs are for processors of the kind x86_64; this one is aarch64'

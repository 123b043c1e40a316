#!/usr/bin/env bash
# tools/packages.sh names packages and sets nothing else: a variable of the script that reads it, such as the system
# that tools/in_system was asked for, stays as it was. Arguments: the script.
set -eu
before=$(compgen -v)
. "$1"
new=$(comm -13 <(sort <<<"$before") <(compgen -v | sort) | grep -vxE 'before|PIPESTATUS|BASH_.*|_' | tr '\n' ' ')
[ "$new" = "packages quick_test_packages release_packages test_packages " ] || { echo "it sets: $new" >&2; exit 1; }
system=asked
. "$1"
[ "$system" = asked ] || { echo "it changes \$system" >&2; exit 1; }
for list in packages quick_test_packages test_packages release_packages; do
    declare -n names=$list
    [ "${#names[@]}" -gt 0 ] || { echo "$list is empty" >&2; exit 1; }
done

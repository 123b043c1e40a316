#!/usr/bin/env bash
# tests/render/compare.sh OLD NEW [FOLDER]
# Draws the same pictures with two builds of vdbcage and compares their bytes: every way of calling `render` in README.md
# and docs/, every option, odd shapes and sizes; each by EGL (hardware, if there is any) and by OSMesa. Inputs are made
# by OLD from data/, in FOLDER (build/compare), and kept for the next time. Pictures of other machines may differ in
# bytes, so no digests are kept: build the older commit and compare. Exit status 1 and a line for each difference.
set -euo pipefail
old=$(realpath "$1")
new=$(realpath "$2")
root=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../..")
work=${3:-$root/build/compare}
mkdir -p "$work"
cd "$work"

if [ ! -e made ]; then
    for model in bishop botijo creature soup open_shell; do cp "$root/data/$model.obj" .; done
    "$old" make bishop.obj -q -o cage.obj --stages stages --effort fast
    "$old" make bishop.obj -q -o a100.obj --faces 100 --effort fast
    "$old" make botijo.obj -q -o b100.obj --faces 100 --effort fast
    "$old" make botijo.obj -q -o quads.obj --mesh triquad --effort fast
    "$old" make creature.obj -q -o creature_cage.obj --mesh triquad --effort fast
    # A pose without vdbcage-walk: y drawn out, x sheared.
    awk '$1 == "v" { $2 = $2 + 0.3 * $3; $3 = 1.2 * $3 } 1' creature_cage.obj >posed.obj
    "$old" deform creature_cage.obj posed.obj creature.obj -o out.obj --coordinates green
    # A model of no thickness; one tiny, one huge, one far away; faces without area; a single triangle.
    printf 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n' >flat.obj
    awk '$1 == "v" { print "v", $2 * 1e-6, $3 * 1e-6, $4 * 1e-6; next } 1' bishop.obj >tiny.obj
    awk '$1 == "v" { print "v", $2 * 1e9, $3 * 1e9, $4 * 1e9; next } 1' bishop.obj >huge.obj
    awk '$1 == "v" { printf "v %.9g %.9g %.9g\n", $2 + 1e6, $3 - 1e6, $4 + 2e6; next } 1' bishop.obj >far.obj
    printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 1 2\nf 1 3 2 4\nf 2 2 2\n' >odd.obj
    printf 'v 0 0 0\nv 1 0 0\nv 0 1 2\nf 1 2 3\n' >one.obj
    touch made
fi

different=0
count=0
# One picture by both builds, each by EGL and, without a vendor of EGL, by OSMesa.
draw() {
    local way
    for way in egl osmesa; do
        local hide=()
        if [ $way = osmesa ]; then hide=(env __EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent); fi
        "${hide[@]}" "$old" render "$@" -o old.png
        "${hide[@]}" "$new" render "$@" -o new.png
        count=$((count + 1))
        if ! cmp -s old.png new.png; then
            different=$((different + 1))
            echo "differs ($way): render $*"
            cp old.png "old$different.png"
            cp new.png "new$different.png"
        fi
    done
}

# README.md, the pictures in it and in docs/, CONTRIBUTING.md
draw bishop.obj
draw bishop.obj cage.obj
draw bishop.obj / stages/solid.vdb / stages/closed.vdb / bishop.obj cage.obj --same-view
draw bishop.obj a100.obj / bishop.obj cage.obj / botijo.obj b100.obj / botijo.obj quads.obj --columns 2
draw out.obj posed.obj / creature.obj creature_cage.obj / out.obj posed.obj --same-view --columns 4 --azimuth -65
# every option
draw bishop.obj cage.obj --influence 7 --coordinates green --size 400x300
draw creature.obj creature_cage.obj --influence 0 --size 400x300
draw soup.obj --size 640x480 --elevation 90
draw open_shell.obj --size 640x480 --azimuth 200 --elevation -30
draw quads.obj --size 500x500 --azimuth 360 --elevation -90
# several wireframes, voxels under and over, pieces of large pictures
draw bishop.obj cage.obj a100.obj quads.obj --size 700x500
draw stages/closed.vdb cage.obj --size 700x500
draw stages/solid.vdb stages/closed.vdb cage.obj --size 300x900
draw bishop.obj cage.obj --size 2100x1500 --azimuth 10
draw botijo.obj quads.obj / stages/surface.obj stages/decimated.obj --size 1301x333
# sizes and shapes
draw bishop.obj cage.obj --size 1x1
draw bishop.obj cage.obj --size 37x211
for model in flat odd one tiny huge far; do draw $model.obj --size 321x243; done
draw flat.obj odd.obj one.obj --size 321x243
draw tiny.obj tiny.obj --size 200x200
draw far.obj far.obj --size 200x200

# the picture of make
"$old" make bishop.obj -q -o old.obj --faces 200 --effort fast --picture old.png
"$new" make bishop.obj -q -o new.obj --faces 200 --effort fast --picture new.png
count=$((count + 1))
if ! cmp -s old.png new.png; then
    different=$((different + 1))
    echo "differs: make --picture"
fi

echo "$count pictures, $different differ"
test $different = 0

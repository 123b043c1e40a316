# Called by in_system, as a user without rights: unpacks the archive below a folder with spaces, and starts the programs
# by links in PATH.
cd
export PATH="$HOME/bin:$PATH"
folder="$HOME/a folder with spaces"
case $1 in
cage)
    mkdir bin "$folder"
    tar -C "$folder" -xf /input/vdbcage-*.tar.xz
    ln -s "$folder"/vdbcage-*/bin/* bin
    cd "$folder"/vdbcage-*/
    vdbcage --version
    vdbcage make data/bishop.obj -o "$HOME/cage.obj"
    vdbcage check "$HOME/cage.obj" data/bishop.obj
    vdbcage-view --help | head -n 3
    vdbcage-bench --help | head -n 3
    ;;
picture)
    cd "$folder"/vdbcage-*/
    vdbcage render data/bishop.obj "$HOME/cage.obj" -o "$HOME/picture.png"
    vdbcage make data/bishop.obj -o "$HOME/gl.obj" --voxelizer gl
    ls -l "$HOME/picture.png"
    ;;
window)
    Xvfb -displayfd 3 -screen 0 1400x900x24 3>"$HOME/display" & # a free one: chroots share them
    server=$!
    trap 'kill $server' EXIT
    sleep 5
    export DISPLAY=:$(cat "$HOME/display")
    cd "$folder"/vdbcage-*/
    printf 'open data/bishop.obj\nwait\nexpect bounding yes\nscreenshot %s\n' "$HOME/window.png" >"$HOME/walk.view"
    vdbcage-view --script "$HOME/walk.view"
    ls -l "$HOME/window.png"
    vdbcage-view data/bishop.obj & # one that stays open
    window=$!
    sleep 10
    grep -o '/[^ ]*\(libGLX_mesa\|libX11\|libXi\|_dri\|libgallium\|libstdc++\)[^ ]*' /proc/$window/maps | sort -u
    kill $window
    ;;
wheel)
    mkdir -p data
    cp /input/creature.obj data
    python3 -m venv --system-site-packages module # NumPy is the system's
    tag=$(python3 -c 'import sys; print("cp%d%d" % sys.version_info[:2])')
    module/bin/pip install --no-index /input/vdbcage-*-$tag-$tag-*.whl
    module/bin/python /input/example.py
    ls -l posed.obj
    ;;
extension)
    if blender --version | grep -q '^Blender 3'; then
        blender --background --python-exit-code 1 --python /input/extension.py -- /input/vdbcage_cage-*.zip
    else
        blender --command extension validate /input/vdbcage_cage-*.zip
        blender --command extension install-file -r user_default --enable /input/vdbcage_cage-*.zip
        blender --background --python-exit-code 1 --python /input/extension.py
    fi
    ;;
esac

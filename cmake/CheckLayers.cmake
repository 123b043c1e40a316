# cmake -P cmake/CheckLayers.cmake: fails, naming every offender, unless the floors of the house hold:
#   core < geometry < mesh < gl < voxelize | volume | surface | check | deform < bounding < pipeline < tools, tests
# A room includes only itself and rooms of lower floors; those of one floor do not know each other. Public headers
# include no private ones. tools/draw and tools/report are for the command and the window, which do not know each other;
# tools/edit is for the window. tools/python, the Python module, uses tools/report. tools/bench measures all.
# Third-party libraries stay in their files.
cmake_minimum_required(VERSION 3.25)
get_filename_component(root ${CMAKE_CURRENT_LIST_DIR}/.. ABSOLUTE)

set(floor_core 0)
set(floor_geometry 1)
set(floor_mesh 2)
set(floor_gl 3)
foreach(room voxelize volume surface check deform)
    set(floor_${room} 4)
endforeach()
set(floor_bounding 5)
set(floor_pipeline 6)

# Rooms have folders; one includes those that come before it in its list, and itself. "." is the room's own folder.
set(folders_vdbcage/bounding/detail guard triangles quads loops fit)
set(folders_vdbcage/volume/detail vdb . cube sphere)
set(folders_vdbcage/deform/detail kernels . families)
set(folders_vdbcage/pipeline/detail . stages search)
set(folders_tools/view state jobs posing files input widgets picture panels .)

set(gpl "CGAL/(Surface_mesh|AABB_|Side_of_triangle_mesh|Polygon_mesh_processing|Polyhedron_3|convex_hull_3|Nef_|[A-Za-z_]*[Tt]riangulation_)")
# library header pattern | files that may include it
set(confined
    "OpenMesh/|^vdbcage/(mesh/detail/open_mesh\\.h|surface/[a-z_]+\\.cpp)$"
    "EGL/|^vdbcage/gl/detail/egl\\.cpp$"
    "tbb/parallel_|^(vdbcage/core/detail/parallel\\.h|tools/.*|tests/.*)$"
    "tbb/task_group|^(vdbcage/core/detail/parallel\\.h|tools/.*|tests/.*)$"
    "png\\.h|^(tools/draw/picture\\.cpp|tests/.*)$"
    "tools/report/|^(tools/(report|cli|view|python|bench)/.*|tests/.*)$"
    "tools/files/|^(tools/(files|cli|view)/.*|tests/.*)$"
    "tools/manual/|^(tools/(manual|cli|view)/.*|tests/.*)$"
    "tools/cli/|^(tools/(cli|bench)/.*|tests/.*)$"
    "tools/draw/|^(tools/(draw|edit|cli|view|bench)/.*|tests/.*)$"
    "tools/edit/|^(tools/(edit|view|bench)/.*|tests/.*)$"
    "tools/view/|^(tools/(view|bench)/.*|tests/.*)$"
    "imgui|^(tools/view/(widgets|panels)/.*|tests/view/.*)$"
    "GLFW/|^tools/view/window\\.cpp$"
    "openssl/|^tools/report/run_facts\\.cpp$"
    "pybind11/|^tools/python/.*$"
    "Python\\.h|^tools/python/.*$"
    "CGAL/|^(vdbcage/.*\\.cpp|tests/.*)$")

set(ofInstructionSets "^vdbcage/deform/detail/kernels/(lanes\\.h|kernel_cage\\.h|row_kernels\\.h|row_kernels_.*)$")

set(problems "")
set(checked 0)
file(GLOB_RECURSE files RELATIVE ${root} ${root}/vdbcage/*.h ${root}/vdbcage/*.cpp ${root}/tools/*.h ${root}/tools/*.cpp
    ${root}/tests/*.h ${root}/tests/*.cpp ${root}/examples/*.cpp)
foreach(file IN LISTS files)
    math(EXPR checked "${checked} + 1")
    file(STRINGS ${root}/${file} lines REGEX "^#[ ]*include")
    set(room "")
    if(file MATCHES "^vdbcage/([a-z]+)/")
        set(room ${CMAKE_MATCH_1})
        if(NOT DEFINED floor_${room})
            list(APPEND problems "${file}: the room ${room} is on no floor")
            continue()
        endif()
    endif()
    foreach(line IN LISTS lines)
        if(NOT line MATCHES "[<\"]([^>\"]+)[>\"]")
            continue()
        endif()
        set(header ${CMAKE_MATCH_1})
        # A function that a header defines could be the linker's choice for sources of all instruction sets.
        if(file MATCHES "${ofInstructionSets}" AND
           NOT header MATCHES "^(cstddef|cstdint|immintrin\\.h|vdbcage/core/detail/pi\\.h|vdbcage/deform/detail/kernels/(lanes|kernel_cage|row_kernels(_of_set)?)\\.h)$")
            list(APPEND problems "${file}: it is compiled for several instruction sets and must not include ${header}")
        endif()
        if(room AND header STREQUAL "vdbcage/vdbcage.h")
            list(APPEND problems "${file}: ${header} is for users: it has the rooms of all floors")
        endif()
        if(room AND header MATCHES "^(support|tools|tests)/")
            list(APPEND problems "${file}: the library includes ${header}")
        endif()
        foreach(parent IN ITEMS
                vdbcage/bounding/detail vdbcage/volume/detail vdbcage/deform/detail vdbcage/pipeline/detail tools/view)
            if(file MATCHES "^${parent}/" AND header MATCHES "^${parent}/")
                foreach(side IN ITEMS file header)
                    if(${side} MATCHES "^${parent}/([a-z]+)/")
                        set(folder ${CMAKE_MATCH_1})
                    else()
                        set(folder .)
                    endif()
                    list(FIND folders_${parent} ${folder} level_${side})
                    if(level_${side} EQUAL -1)
                        list(APPEND problems "${file}: the folder ${parent}/${folder} has no place in the order")
                    endif()
                endforeach()
                if(level_header GREATER level_file)
                    list(APPEND problems "${file}: ${header} comes after its folder")
                endif()
            endif()
        endforeach()
        if(room AND header MATCHES "^vdbcage/([a-z]+)/")
            set(other ${CMAKE_MATCH_1})
            if(NOT other STREQUAL room AND NOT floor_${other} LESS floor_${room})
                list(APPEND problems "${file}: ${room} must not include ${header}")
            endif()
        endif()
        if(header MATCHES "/detail/|^vdbcage/(geometry|gl|mesh/io)/" AND
           (file MATCHES "^examples/" OR (file MATCHES "^vdbcage/[a-z]+/[a-z_]+\\.h$" AND NOT room MATCHES "^(geometry|gl)$")))
            list(APPEND problems "${file}: a public header or an example includes the private ${header}")
        endif()
        foreach(rule IN LISTS confined)
            string(FIND "${rule}" "|" bar)
            string(SUBSTRING "${rule}" 0 ${bar} pattern)
            math(EXPR bar "${bar} + 1")
            string(SUBSTRING "${rule}" ${bar} -1 allowed)
            if(header MATCHES "^${pattern}" AND NOT file MATCHES "${allowed}")
                list(APPEND problems "${file}: ${header} does not belong here")
            endif()
        endforeach()
        if(room AND header MATCHES "^${gpl}" AND NOT file MATCHES "^vdbcage/(surface/repair|voxelize/detail/cgal)\\.cpp$")
            list(APPEND problems "${file}: ${header} is GPL; it belongs to the optional part only")
        endif()
    endforeach()
endforeach()
if(checked LESS 20)
    list(APPEND problems "only ${checked} files were found below ${root}")
endif()
if(problems)
    list(JOIN problems "\n  " text)
    message(FATAL_ERROR "The layers do not hold:\n  ${text}")
endif()
message(STATUS "the layers hold in ${checked} files")

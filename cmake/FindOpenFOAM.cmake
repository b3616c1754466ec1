# SPDX-License-Identifier: LGPL-2.1-or-later
#
# OpenFOAM as Debian packages it (libraries without headers), with the headers that
# cmake/fetch-openfoam-headers puts into the user's cache.
#
#   find_package(OpenFOAM REQUIRED)
#   target_link_libraries(my_target PRIVATE OpenFOAM::finiteVolume)
#
# Targets:
#   OpenFOAM::finiteVolume   fvCFD.H and what it needs; links finiteVolume, meshTools, OpenFOAM, Pstream
#   OpenFOAM::headers        headers and definitions only
# Variables:
#   OpenFOAM_VERSION              upstream version of the installed library, when dpkg knows it
#   TURBIDITE_OPENFOAM_INCLUDE    flat header folder; set it for an OpenFOAM from elsewhere
#
# The headers do not compile as C++20: targets that use them need `CXX_STANDARD 17`.

set(TURBIDITE_OPENFOAM_INCLUDE "" CACHE PATH
    "Flat folder of OpenFOAM's headers; empty: where cmake/fetch-openfoam-headers puts them")

set(_openfoam_fetch "${CMAKE_CURRENT_LIST_DIR}/fetch-openfoam-headers")
set(_openfoam_include "${TURBIDITE_OPENFOAM_INCLUDE}")
if(NOT _openfoam_include)
    execute_process(COMMAND "${_openfoam_fetch}" --print-dir
                    OUTPUT_VARIABLE _openfoam_include OUTPUT_STRIP_TRAILING_WHITESPACE
                    ERROR_VARIABLE _openfoam_error ERROR_STRIP_TRAILING_WHITESPACE)
endif()

if(EXISTS "${_openfoam_include}/fvCFD.H")
    set(OpenFOAM_INCLUDE_DIR "${_openfoam_include}")
else()
    set(OpenFOAM_INCLUDE_DIR OpenFOAM_INCLUDE_DIR-NOTFOUND)
    string(CONCAT _openfoam_reason
        "OpenFOAM's headers are missing: no fvCFD.H in '${_openfoam_include}'. ${_openfoam_error} Debian "
        "does not package them. Run\n  ${_openfoam_fetch}\n(network, no root rights, and ./turbidite does it by "
        "itself) or set TURBIDITE_OPENFOAM_INCLUDE to a folder with all headers side by side.")
endif()
string(REPLACE ";" "," _openfoam_reason "${_openfoam_reason}")

execute_process(COMMAND dpkg-query --show "--showformat=\${source:Upstream-Version}" libopenfoam
                OUTPUT_VARIABLE OpenFOAM_VERSION ERROR_QUIET RESULT_VARIABLE _openfoam_dpkg)
if(NOT _openfoam_dpkg EQUAL 0)
    unset(OpenFOAM_VERSION)
endif()

# Debian installs the libraries directly in /usr/lib, next to a folder of dummies: no suffixes.
set(_openfoam_libraries finiteVolume meshTools OpenFOAM Pstream)
set(_openfoam_library_variables "")
foreach(_library IN LISTS _openfoam_libraries)
    find_library(OpenFOAM_${_library}_LIBRARY ${_library} PATHS /usr/lib ENV FOAM_LIBBIN)
    mark_as_advanced(OpenFOAM_${_library}_LIBRARY)
    list(APPEND _openfoam_library_variables OpenFOAM_${_library}_LIBRARY)
endforeach()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenFOAM
    REQUIRED_VARS OpenFOAM_INCLUDE_DIR ${_openfoam_library_variables}
    VERSION_VAR OpenFOAM_VERSION
    REASON_FAILURE_MESSAGE "${_openfoam_reason}")

if(OpenFOAM_FOUND AND NOT TARGET OpenFOAM::headers)
    # The options the packaged library was built with; another label or scalar size would not link, and
    # NoRepository makes headers include the template sources.
    add_library(OpenFOAM::headers INTERFACE IMPORTED)
    target_include_directories(OpenFOAM::headers SYSTEM INTERFACE "${OpenFOAM_INCLUDE_DIR}")
    target_compile_definitions(OpenFOAM::headers INTERFACE
        linux64 WM_ARCH_OPTION=64 WM_DP WM_LABEL_SIZE=32 NoRepository)

    add_library(OpenFOAM::finiteVolume INTERFACE IMPORTED)
    target_link_libraries(OpenFOAM::finiteVolume INTERFACE OpenFOAM::headers)
    foreach(_library IN LISTS _openfoam_libraries)
        target_link_libraries(OpenFOAM::finiteVolume INTERFACE "${OpenFOAM_${_library}_LIBRARY}")
    endforeach()
endif()

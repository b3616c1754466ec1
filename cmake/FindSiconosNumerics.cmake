# Siconos' solvers for contact problems (Debian: libsiconos-numerics-dev), which has no CMake files of its
# own. Imported target: Siconos::numerics.
find_path(SiconosNumerics_INCLUDE_DIR siconos/numerics/FrictionContactProblem.h)
find_library(SiconosNumerics_LIBRARY siconos_numerics)
find_library(SiconosExternals_LIBRARY siconos_externals)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(SiconosNumerics REQUIRED_VARS
    SiconosNumerics_LIBRARY SiconosExternals_LIBRARY SiconosNumerics_INCLUDE_DIR)

if(SiconosNumerics_FOUND AND NOT TARGET Siconos::numerics)
    add_library(Siconos::numerics INTERFACE IMPORTED)
    set_target_properties(Siconos::numerics PROPERTIES
        INTERFACE_INCLUDE_DIRECTORIES
            "${SiconosNumerics_INCLUDE_DIR}/siconos;${SiconosNumerics_INCLUDE_DIR}/siconos/numerics"
        INTERFACE_LINK_LIBRARIES "${SiconosNumerics_LIBRARY};${SiconosExternals_LIBRARY}")
endif()

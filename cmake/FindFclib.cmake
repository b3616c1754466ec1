# FCLIB, files of friction problems in HDF5 (Debian: libfclib-dev). Its own CMake files look for HDF5 of the
# machine, which only the library itself needs. Imported target: Fclib::fclib.
find_path(Fclib_INCLUDE_DIR fclib.h)
find_library(Fclib_LIBRARY fclib)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Fclib REQUIRED_VARS Fclib_LIBRARY Fclib_INCLUDE_DIR)

if(Fclib_FOUND AND NOT TARGET Fclib::fclib)
    add_library(Fclib::fclib INTERFACE IMPORTED)
    set_target_properties(Fclib::fclib PROPERTIES
        INTERFACE_INCLUDE_DIRECTORIES "${Fclib_INCLUDE_DIR}" INTERFACE_LINK_LIBRARIES "${Fclib_LIBRARY}")
endif()

# `cmake --build build/release --target package` makes turbidite_VERSION_ARCH.deb and turbidite-dev_VERSION_ARCH.deb in
# the build folder, from the components run and dev of the install rules.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME turbidite)
set(CPACK_PACKAGE_CONTACT "Turbidite maintainers <maintainers@turbidite.invalid>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL run dev)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/package-folders.cmake)
set(CPACK_PROJECT_CONFIG_FILE ${PROJECT_SOURCE_DIR}/cmake/package-version.cmake)
set(CPACK_TURBIDITE_SOURCE ${PROJECT_SOURCE_DIR})
set(CPACK_TURBIDITE_VERSION ${PROJECT_VERSION})
set(docs ${PROJECT_BINARY_DIR}/package)
file(MAKE_DIRECTORY ${docs})

set(CPACK_DEBIAN_RUN_PACKAGE_NAME turbidite)
set(CPACK_DEBIAN_RUN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_RUN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_RUN_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/cmake/package/prerm)
# dpkg-shlibdeps looks beside the packaged files too.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/lib)
# What no file of shared libraries tells: OpenFOAM's libraries have none (their ABI is that of the release), YADE and
# Python modules are loaded by name, programs are started.
set(CPACK_DEBIAN_RUN_PACKAGE_DEPENDS
    "openfoam (>= 1912.200626), openfoam (<< 1913~), libopenfoam (>= 1912.200626), libopenfoam (<< 1913~), yade (>= 2023.02a), yade (<< 2023.03~), openmpi-bin, python3 (>= 3.11), python3-numpy, python3-matplotlib, python3-mpi4py")
set(CPACK_DEBIAN_RUN_PACKAGE_RECOMMENDS "python3-pandas")
set(CPACK_DEBIAN_RUN_DESCRIPTION "immersed granular flows: OpenFOAM and YADE in one simulation
Grains in a liquid, particle-resolved in the plane and in space: the liquid
by a distributed-multiplier fictitious-domain method in OpenFOAM, the grains
by non-smooth contact dynamics in YADE, by molecular dynamics in YADE or
LAMMPS, or by a program of one's own, coupled over MPI. With cases, reports
and the studies of Topin et al. (2011).")

set(CPACK_DEBIAN_DEV_PACKAGE_NAME turbidite-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_DEV_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/cmake/package/triggers)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "libopenmpi-dev")
set(CPACK_DEBIAN_DEV_PACKAGE_RECOMMENDS "turbidite")
set(CPACK_DEBIAN_DEV_DESCRIPTION "immersed granular flows: to couple a grains program of one's own
Headers and libraries in C++ and C, a module for Python, and examples: a
program that moves grains takes part in a run of Turbidite as an adapter.")

# Debian asks for a copyright and a changelog in every package.
execute_process(COMMAND gzip -9n -c ${PROJECT_SOURCE_DIR}/cmake/package/changelog OUTPUT_FILE ${docs}/changelog.gz
                WORKING_DIRECTORY ${PROJECT_BINARY_DIR} COMMAND_ERROR_IS_FATAL ANY)
foreach(package turbidite turbidite-dev)
    string(REPLACE "turbidite-dev" dev component ${package})
    string(REPLACE "turbidite" run component ${component})
    install(FILES cmake/package/copyright ${docs}/changelog.gz DESTINATION share/doc/${package} COMPONENT ${component})
endforeach()
include(CPack)

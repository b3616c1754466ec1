# Read by CPack: the package has the version of the project and the time of its commit, so that the later one is an upgrade.
execute_process(COMMAND git -C ${CPACK_TURBIDITE_SOURCE} log -1 --date=format:%Y%m%d.%H%M%S --format=+git%cd.%h --abbrev=10
                OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
set(CPACK_DEBIAN_PACKAGE_VERSION ${CPACK_TURBIDITE_VERSION}${commit})
set(CPACK_DEBIAN_DEV_PACKAGE_VERSION ${CPACK_DEBIAN_PACKAGE_VERSION})
set(CPACK_PACKAGE_VERSION ${CPACK_DEBIAN_PACKAGE_VERSION})

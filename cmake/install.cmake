# What a run needs, under a prefix: `cmake --install build/release --component run --prefix PREFIX`. Programs,
# modules and scripts keep the places that they have to each other in the build and source tree
# (launcher/job/programs.hpp):
#     PREFIX/bin/turbidite               a link to the program below
#     PREFIX/lib/turbidite/bin, lib      as build/release/bin, lib
#     PREFIX/share/turbidite             as the source tree: configs, launcher/report, launcher/python
#     PREFIX/lib/python3/dist-packages   a link to launcher/python/turbidite, where Debian's Python looks with PREFIX /usr
set(run_root lib/turbidite)
set(programs turbidite turbidite-member turbidite-partner turbidite-replay turbidite-coupler turbidite-fluid-box
             turbidite-grains turbidite-grains-md)
set(libraries turbidite_world_isolation turbidite_c)
set(yade_modules turbidite_yade turbidite_contact_engine)
if(TURBIDITE_OPENFOAM)
    list(APPEND programs turbidite-fluid)
    list(APPEND libraries turbiditeFFT)
endif()
if(TARGET turbidite-lammps)
    list(APPEND programs turbidite-lammps)
endif()

set_target_properties(${programs} PROPERTIES INSTALL_RPATH "$ORIGIN/../lib")
set_target_properties(${libraries} ${yade_modules} PROPERTIES INSTALL_RPATH "")
install(TARGETS ${programs} RUNTIME DESTINATION ${run_root}/bin COMPONENT run)
install(TARGETS ${libraries} LIBRARY DESTINATION ${run_root}/lib COMPONENT run)
install(TARGETS ${yade_modules} LIBRARY DESTINATION ${run_root}/lib/yade COMPONENT run)
install(DIRECTORY ${PROJECT_BINARY_DIR}/lib/yade ${PROJECT_BINARY_DIR}/lib/python DESTINATION ${run_root}/lib COMPONENT run
        FILES_MATCHING PATTERN "*.py" PATTERN __pycache__ EXCLUDE)

# Links are made once, relative, so that a prefix may be moved.
set(links ${PROJECT_BINARY_DIR}/links)
file(MAKE_DIRECTORY ${links}/python)
file(CREATE_LINK ../${run_root}/bin/turbidite ${links}/turbidite SYMBOLIC)
file(CREATE_LINK ../../../share/turbidite/launcher/python/turbidite ${links}/python/turbidite SYMBOLIC)
install(FILES ${links}/turbidite DESTINATION bin COMPONENT run)
install(FILES ${links}/python/turbidite DESTINATION lib/python3/dist-packages COMPONENT run)

foreach(folder configs launcher/report launcher/python launcher/site)
    get_filename_component(parent ${folder} DIRECTORY)
    install(DIRECTORY ${folder} DESTINATION share/turbidite/${parent} COMPONENT run
            PATTERN "*.[ch]pp" EXCLUDE PATTERN __pycache__ EXCLUDE PATTERN runs EXCLUDE PATTERN "*~" EXCLUDE)
endforeach()
install(DIRECTORY docs DESTINATION share/doc/turbidite COMPONENT run)
install(FILES README.md SECURITY.md CITATION.cff DESTINATION share/doc/turbidite COMPONENT run)

# The site of `turbidite docs`; programs are built without mkdocs too, and the site without doxygen.
find_program(MKDOCS mkdocs)
if(MKDOCS)
    file(GLOB pages CONFIGURE_DEPENDS *.md docs/*.md docs/*/*.md docs/images/*.png docs/images/*/*.png configs/*.md)
    file(GLOB reference CONFIGURE_DEPENDS coupler/participant/*.h* coupler/participant/python/*.py coupler/protocol/*.hpp coupler/protocol/*/*.hpp
         coupler/rigid/*.hpp coupler/transport/*.hpp launcher/site/api/*)
    set(site ${PROJECT_BINARY_DIR}/site)
    add_custom_command(OUTPUT ${site}/index.html
        COMMAND /usr/bin/python3 -B ${PROJECT_SOURCE_DIR}/launcher/site/site.py build ${PROJECT_SOURCE_DIR} ${site}
        DEPENDS ${pages} ${reference} launcher/site/site.py launcher/site/mkdocs.yml VERBATIM)
    add_custom_target(site ALL DEPENDS ${site}/index.html)
    install(DIRECTORY ${site}/ DESTINATION share/doc/turbidite/html OPTIONAL COMPONENT run)
endif()

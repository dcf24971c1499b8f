# What `cmake --install` puts where, and what cpack makes of it: the program, and for other programs the libraries under
# the names brainshift::segmentation, brainshift::discretise, brainshift::solve and brainshift::registration.
include(CMakePackageConfigHelpers)

install(TARGETS brainshift RUNTIME COMPONENT program)
install(TARGETS brainshift_program RUNTIME DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/brainshift COMPONENT program)
install(FILES pipelines/package/copyright DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
find_program(GZIP_PROGRAM gzip REQUIRED)
execute_process(COMMAND ${GZIP_PROGRAM} -9nc ${PROJECT_SOURCE_DIR}/pipelines/package/changelog
  OUTPUT_FILE ${PROJECT_BINARY_DIR}/changelog.gz)
install(FILES ${PROJECT_BINARY_DIR}/changelog.gz DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)

set(libraries options geometry image files segmentation discretise solve registration)
foreach(library ${libraries})
  set_target_properties(brainshift_${library} PROPERTIES EXPORT_NAME ${library})
  add_library(brainshift::${library} ALIAS brainshift_${library})
  list(APPEND targets brainshift_${library})
endforeach()
set_target_properties(brainshift_flags PROPERTIES EXPORT_NAME flags)
install(TARGETS brainshift_flags ${targets} EXPORT brainshift_targets ARCHIVE COMPONENT library)
install(EXPORT brainshift_targets NAMESPACE brainshift:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/brainshift
  COMPONENT library)
install(DIRECTORY segmentation discretise solve register DESTINATION ${BRAINSHIFT_HEADERS} COMPONENT library
  FILES_MATCHING PATTERN "*.hpp" PATTERN "*_bridge.hpp" EXCLUDE)
configure_package_config_file(pipelines/package/brainshift-config.cmake.in ${PROJECT_BINARY_DIR}/brainshift-config.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/brainshift)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/brainshift-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/brainshift-config.cmake ${PROJECT_BINARY_DIR}/brainshift-config-version.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/brainshift COMPONENT library)

# The BIDS App: scripts in one folder, which the commands on the path lead to.
set(cohorts ${CMAKE_INSTALL_DATADIR}/brainshift/bids)
install(DIRECTORY pipelines/bids/ DESTINATION ${cohorts} COMPONENT program USE_SOURCE_PERMISSIONS
  PATTERN "*.md" EXCLUDE PATTERN Dockerfile EXCLUDE PATTERN __pycache__ EXCLUDE)
foreach(command brainshift-bids brainshift-sweep)
  file(CREATE_LINK ../share/brainshift/bids/${command} ${PROJECT_BINARY_DIR}/${command} SYMBOLIC)
  install(FILES ${PROJECT_BINARY_DIR}/${command} DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
endforeach()

# help2man writes the pages from the commands' own help; those of the BIDS App ask the program for the version.
find_program(HELP2MAN help2man)
function(man_page name command sentence)
  set(page ${PROJECT_BINARY_DIR}/${name}.1.gz)
  add_custom_command(OUTPUT ${page}
    COMMAND ${CMAKE_COMMAND} -E env BRAINSHIFT=$<TARGET_FILE:brainshift>
      bash ${PROJECT_SOURCE_DIR}/pipelines/package/man_page.sh ${HELP2MAN} ${command} ${sentence} ${page}
    DEPENDS brainshift brainshift_program ${PROJECT_SOURCE_DIR}/pipelines/package/man_page.sh ${ARGN} VERBATIM)
  set_property(GLOBAL APPEND PROPERTY brainshift_man_pages ${page})
  install(FILES ${page} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
endfunction()
if(HELP2MAN)
  man_page(brainshift $<TARGET_FILE:brainshift> "computes how the brain moved in an operation and warps its MRI")
  set(app ${PROJECT_SOURCE_DIR}/pipelines/bids)
  file(GLOB parts ${app}/cohort/*.py)
  man_page(brainshift-bids ${app}/brainshift-bids "computes the brain shift of the participants of a BIDS folder"
    ${app}/brainshift-bids ${parts})
  man_page(brainshift-sweep ${app}/brainshift-sweep "computes the brain shift of a table of scenes and options"
    ${app}/brainshift-sweep ${parts})
  get_property(pages GLOBAL PROPERTY brainshift_man_pages)
  add_custom_target(man_pages ALL DEPENDS ${pages})
endif()

set(CPACK_PACKAGE_NAME brainshift)
set(CPACK_PACKAGE_VENDOR "brainshift")
set(CPACK_PACKAGE_CONTACT "the brainshift developers <brainshift@example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "When the skull is opened the brain sags, and the preoperative
MRI no longer fits. brainshift takes a labelled head MRI and the displacements
measured on the exposed cortex, computes how the whole brain moved by
mechanics (meshless total Lagrangian explicit dynamics) and warps the MRI to
match. Research software, not a medical device.")
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL program)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME brainshift)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS python3:any)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "snakemake, slurm-wlm")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
if(BRAINSHIFT_PYTHON)
  include(pipelines/python/install.cmake)
endif()
include(CPack)

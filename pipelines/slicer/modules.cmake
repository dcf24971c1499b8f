# The modules of 3D Slicer, in one folder that Slicer takes as a path of modules: share/brainshift/slicer, of the build
# and of what is installed.
set(modules ${PROJECT_BINARY_DIR}/share/brainshift/slicer)
set(installed ${CMAKE_INSTALL_DATADIR}/brainshift/slicer)

# launcher(FILE PROGRAM): the command-line module, which starts that program.
set(executable OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
file(READ slicer/BrainShift.in launcher)
function(launcher file BRAINSHIFT_PROGRAM)
  string(CONFIGURE "${launcher}" text @ONLY)
  file(GENERATE OUTPUT ${file} CONTENT "${text}" FILE_PERMISSIONS ${executable})
endfunction()
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS slicer/BrainShift.in)
launcher(${modules}/BrainShift $<TARGET_FILE:brainshift>)
file(RELATIVE_PATH program /${installed} /${CMAKE_INSTALL_BINDIR}/brainshift)
launcher(${CMAKE_CURRENT_BINARY_DIR}/slicer/BrainShift "$(dirname \"$(readlink -f \"$0\")\")/${program}")

# Slicer reads the description where it lies beside the module, and starts nothing.
add_custom_command(TARGET brainshift_program POST_BUILD COMMAND brainshift_program slicer --xml > ${modules}/BrainShift.xml VERBATIM)

configure_file(slicer/BrainShiftPanel.py ${modules}/BrainShiftPanel.py COPYONLY)
configure_file(slicer/BrainShiftLib/__init__.py ${modules}/BrainShiftLib/__init__.py COPYONLY)
configure_file(slicer/BrainShiftLib/logic.py ${modules}/BrainShiftLib/logic.py COPYONLY)
configure_file(show/open_in_slicer.py ${modules}/BrainShiftLib/open_in_slicer.py COPYONLY)

install(PROGRAMS ${CMAKE_CURRENT_BINARY_DIR}/slicer/BrainShift DESTINATION ${installed} COMPONENT program)
install(DIRECTORY ${modules}/ DESTINATION ${installed} COMPONENT program
  FILES_MATCHING PATTERN "*.py" PATTERN "*.xml" PATTERN "__pycache__" EXCLUDE)

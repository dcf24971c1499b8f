# SPDX-License-Identifier: GPL-3.0-or-later
# The page's view: viewer_run.js, viewer.js and the two libraries they call, as npm packs them. Where setup.sh could not
# fetch them the program is built without, and its page does not turn.
set(BRAINSHIFT_NPM ${PROJECT_SOURCE_DIR}/build/npm CACHE PATH "Folder of the packages that 'npm pack' fetched")
find_program(BASE64_PROGRAM base64 REQUIRED)
find_program(GZIP_PROGRAM gzip REQUIRED)

# Adds a file to the list of what the page holds: its name there, and the text of its compressed bytes.
function(brainshift_embed name file)
  execute_process(COMMAND ${GZIP_PROGRAM} -9nc ${file} COMMAND ${BASE64_PROGRAM} -w0 OUTPUT_VARIABLE text
    COMMAND_ERROR_IS_FATAL ANY)
  set(BRAINSHIFT_VIEWER_LIBRARIES "${BRAINSHIFT_VIEWER_LIBRARIES}\n      {\"${name}\", \"${text}\"}," PARENT_SCOPE)
endfunction()

# The files of a package; its checksum is that of the package as npm has it.
function(brainshift_unpack package sha256)
  file(SHA256 ${BRAINSHIFT_NPM}/${package}.tgz found)
  if(NOT found STREQUAL sha256)
    message(FATAL_ERROR "${BRAINSHIFT_NPM}/${package}.tgz is not the package that was tested; remove it")
  endif()
  file(ARCHIVE_EXTRACT INPUT ${BRAINSHIFT_NPM}/${package}.tgz DESTINATION ${PROJECT_BINARY_DIR}/npm_${package})
endfunction()

if(EXISTS ${BRAINSHIFT_NPM}/niivue-niivue-0.69.0.tgz AND EXISTS ${BRAINSHIFT_NPM}/uplot-1.6.32.tgz)
  brainshift_unpack(niivue-niivue-0.69.0 6e9a6a471b428eb3b258a0086beca9187d95e43a781a39e8a519c6da246af485)
  brainshift_unpack(uplot-1.6.32 4b8a8191e425658e3ea8c8c1314b0fc679c861ee3a1af2b20c7b16ba50b5133d)
  brainshift_embed(niivue ${PROJECT_BINARY_DIR}/npm_niivue-niivue-0.69.0/package/dist/niivue.umd.js)
  brainshift_embed(uplot ${PROJECT_BINARY_DIR}/npm_uplot-1.6.32/package/dist/uPlot.iife.min.js)
  brainshift_embed(uplot_style ${PROJECT_BINARY_DIR}/npm_uplot-1.6.32/package/dist/uPlot.min.css)
  # The Apache licence wants its text to go along with the code.
  file(READ ${PROJECT_SOURCE_DIR}/pipelines/package/copyright licences)
  if(EXISTS /usr/share/common-licenses/Apache-2.0)
    file(READ /usr/share/common-licenses/Apache-2.0 apache)
    string(APPEND licences "\n${apache}")
  endif()
  file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/report/licences.txt "${licences}")
  brainshift_embed(copyright ${CMAKE_CURRENT_BINARY_DIR}/report/licences.txt)
else()
  message(STATUS "No packages of npm in ${BRAINSHIFT_NPM}: the report will not turn")
endif()

file(READ report/page.html BRAINSHIFT_PAGE)
file(READ report/viewer_run.js BRAINSHIFT_VIEWER_RUN)
file(READ report/viewer.js BRAINSHIFT_VIEWER)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS report/page.html report/viewer_run.js report/viewer.js
  ${PROJECT_SOURCE_DIR}/pipelines/package/copyright)
configure_file(report/page_html.cpp.in report/page_html.cpp @ONLY)

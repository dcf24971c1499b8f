# Where Debian's Python looks for the modules of packages, and the package of its own that Debian asks for.
set(BRAINSHIFT_PYTHON_DIR lib/python3/dist-packages CACHE STRING "Folder of Python modules under the prefix")
install(TARGETS brainshift_python LIBRARY DESTINATION ${BRAINSHIFT_PYTHON_DIR}/brainshift COMPONENT python)
install(FILES pipelines/python/init.py DESTINATION ${BRAINSHIFT_PYTHON_DIR}/brainshift RENAME __init__.py
  COMPONENT python)
install(FILES pipelines/package/copyright ${PROJECT_BINARY_DIR}/changelog.gz
  DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/python3-brainshift COMPONENT python)

list(APPEND CPACK_COMPONENTS_ALL python)
math(EXPR next_minor "${Python_VERSION_MINOR} + 1")
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-brainshift)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
  "python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${next_minor}), python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS python3-nibabel)
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
  ${PROJECT_SOURCE_DIR}/pipelines/python/postinst ${PROJECT_SOURCE_DIR}/pipelines/python/prerm)
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "Python module of brainshift
Computes from a labelled head MRI and the displacements measured on the
exposed cortex how the whole brain moved, by mechanics, on numpy arrays or by
a scene, and warps the MRI to match. Research software, not a medical device.")

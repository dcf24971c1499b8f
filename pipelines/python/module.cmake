# The module as `import brainshift` finds it: build/python on PYTHONPATH, or installed for Debian's Python.
set(module ${PROJECT_BINARY_DIR}/python/brainshift)
pybind11_add_module(brainshift_python MODULE NO_EXTRAS python/images.cpp python/module.cpp python/results.cpp)
set_target_properties(brainshift_python PROPERTIES OUTPUT_NAME _core LIBRARY_OUTPUT_DIRECTORY ${module})
target_link_libraries(brainshift_python PRIVATE brainshift_pipelines)
configure_file(python/init.py ${module}/__init__.py COPYONLY)

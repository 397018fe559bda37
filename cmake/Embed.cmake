# gramap_embed(LIBRARY NAME FILE): takes a file's bytes into a library, so that the program needs nothing beside itself,
# wherever it is installed. geometry/embedded.h gives them to the code.
function(gramap_embed library name file)
  set(NAME ${name})
  set(FILE ${file})
  set(source ${CMAKE_CURRENT_BINARY_DIR}/embedded_${name}.cpp)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/embedded.cpp.in ${source} @ONLY)
  set_source_files_properties(${source} PROPERTIES OBJECT_DEPENDS ${file})
  target_sources(${library} PRIVATE ${source})
endfunction()

cmake_minimum_required(VERSION 3.22)
# Writes OUTPUT, which defines coseg::source_fingerprint(piece): for each kind of piece that a state folder or a model keeps,
# a hash of SETTINGS and of the sources below ROOT that the piece depends on.
#
# These are the files PIECE_ROOTS with all that they include. A header also stands for the source of its name, and for
# sources of its room that include it and have no header of their own. Rooms in PIECE_GIVEN are left out: what comes from
# them reaches the piece as values, which its key has by their content, or does not reach it at all. Comments and white space
# do not count.

# A mesh's description is a function of the mesh's bytes and of the options of the description. Mesh formats are read and
# written in one unit, and what is written has the colours of pictures.
set(descriptions_ROOTS mpi_drivers/describe/mesh_description.cpp mpi_drivers/describe/description_file.cpp)
set(descriptions_GIVEN mpi_drivers/options mpi_drivers/process src/pictures)

# Tiles and iterates of the optimiser are functions of the problem and of the options of the solve.
set(solutions_ROOTS solvers/variants/subspace_variants.cpp mpi_drivers/optimise/solver_checkpoint_files.cpp
  mpi_drivers/optimise/iterate_file.cpp)
set(solutions_GIVEN mpi_drivers/options mpi_drivers/process mpi_drivers/describe)

# A cut is a function of the coefficients, of what ties patches together and of the options of the run.
set(cuts_ROOTS mpi_drivers/partition/cut_stage.cpp mpi_drivers/partition/partition_checkpoint.cpp)
set(cuts_GIVEN mpi_drivers/options mpi_drivers/process mpi_drivers/describe mpi_drivers/optimise)

# The features of a model's patches: the features of a later mesh are compared with them.
set(features_ROOTS mpi_drivers/describe/mesh_description.cpp mpi_drivers/describe/feature_stage.cpp)
set(features_GIVEN mpi_drivers/options mpi_drivers/process solvers/choice solvers/partition src/pictures)

set(pieces descriptions solutions cuts features)

# Source is texts, characters and other tokens, which stay, each with the comments and white space after it, which go. A text
# may hold what looks like a comment.
set(token "\"([^\"\\\n]|\\\\.)*\"|'([^'\\\n]|\\\\.)'|[^/\"' \t\r\n]+|'|\"|/")
set(dropped "(//[^\n]*|/[*]([^*]|[*]+[^*/])*[*]+/|[ \t\r\n]+)*")

foreach(folder src io solvers mpi_drivers)
  file(GLOB_RECURSE sources RELATIVE ${ROOT} ${ROOT}/${folder}/*.cpp ${ROOT}/${folder}/*.hpp)
  foreach(source ${sources})
    file(READ ${ROOT}/${source} content)
    string(REGEX MATCHALL "#include \"[^\"]+\"" included "${content}")
    string(REGEX REPLACE "#include \"([^\"]+)\"" "\\1" included_${source} "${included}")
    string(REGEX REPLACE "(${token})${dropped}" "\\1" content "begin ${content}")
    string(SHA256 hash_${source} "${content}")
  endforeach()
  list(APPEND all_sources ${sources})
endforeach()

foreach(source ${all_sources})
  string(REGEX REPLACE "\\.cpp$" ".hpp" header ${source})
  if(DEFINED hash_${header})
    list(APPEND implementation_${header} ${source})
    continue()
  endif()
  get_filename_component(room ${source} DIRECTORY)
  foreach(header ${included_${source}})
    get_filename_component(header_room ${header} DIRECTORY)
    if(header_room STREQUAL room)
      list(APPEND implementation_${header} ${source})
    endif()
  endforeach()
endforeach()

# The files that the piece depends on, sorted, into `result`.
function(files_of piece result)
  set(waiting ${${piece}_ROOTS})
  set(found)
  while(waiting)
    list(POP_FRONT waiting file)
    get_filename_component(room ${file} DIRECTORY)
    if(file IN_LIST found OR room IN_LIST ${piece}_GIVEN)
      continue()
    endif()
    if(NOT DEFINED hash_${file})
      message(FATAL_ERROR "${file}, which the fingerprint of ${piece} needs, is not there")
    endif()
    list(APPEND found ${file})
    list(APPEND waiting ${included_${file}} ${implementation_${file}})
  endwhile()
  list(SORT found)
  set(${result} ${found} PARENT_SCOPE)
endfunction()

set(cases "")
foreach(piece ${pieces})
  files_of(${piece} files)
  set(hashes "${SETTINGS}")
  foreach(file ${files})
    string(APPEND hashes " ${file} ${hash_${file}}")
  endforeach()
  string(SHA256 fingerprint "${hashes}")
  string(SUBSTRING ${fingerprint} 0 32 fingerprint)
  list(LENGTH files count)
  string(APPEND cases "        case KeptPiece::${piece}:  // ${count} files\n            return \"${fingerprint}\";\n")
  if(LIST_FILES)
    message("${piece}: ${files}")
  endif()
endforeach()

set(generated "#include \"mpi_drivers/process/source_fingerprint.hpp\"

namespace coseg {

std::string source_fingerprint(KeptPiece piece) {
    switch (piece) {
${cases}    }
    return \"\";
}

}  // namespace coseg
")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} before)
endif()
if(NOT "${before}" STREQUAL "${generated}")
  file(WRITE ${OUTPUT} "${generated}")
endif()

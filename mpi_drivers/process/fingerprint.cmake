# Writes OUTPUT, which defines coseg::source_fingerprint(): a hash of SETTINGS and of the files in the folders FOLDERS (A,B,...) below ROOT.
set(text "${SETTINGS}")
string(REPLACE "," ";" folders "${FOLDERS}")
foreach(folder ${folders})
  file(GLOB_RECURSE sources ${ROOT}/${folder}/*.cpp ${ROOT}/${folder}/*.hpp)
  list(SORT sources)
  foreach(source ${sources})
    file(SHA256 ${source} hash)
    string(APPEND text " ${hash}")
  endforeach()
endforeach()
string(SHA256 fingerprint "${text}")
string(SUBSTRING ${fingerprint} 0 32 fingerprint)
file(WRITE ${OUTPUT} "#include \"mpi_drivers/process/source_fingerprint.hpp\"\n
namespace coseg {\n
std::string source_fingerprint() { return \"${fingerprint}\"; }\n
}  // namespace coseg\n")

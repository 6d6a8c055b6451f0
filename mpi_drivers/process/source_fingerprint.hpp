#pragma once
// What tells one build's results from another's.

#include <string>

namespace coseg {

/// A hash of the sources and settings that results depend on, made when the program is built. State of
/// another build is not used: a change of a descriptor must not meet results of the old one.
std::string source_fingerprint();

}  // namespace coseg

#pragma once
// What tells the results of one build from those of another.

#include <string>

namespace coseg {

/// What is kept from one run to the next.
enum class KeptPiece {
    descriptions,  ///< of meshes
    solutions,     ///< tiles and iterates of the optimiser
    cuts,
    features,  ///< of the patches of a model
};

/// A hash of the settings of the build and of the sources that a piece depends on (fingerprint.cmake), made
/// when the program is built. A piece with another one is not used: what a changed descriptor would give must
/// not meet results of the old one. Comments, white space and files that cannot change the piece have no part
/// in it.
std::string source_fingerprint(KeptPiece piece);

}  // namespace coseg

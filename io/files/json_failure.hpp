#pragma once
// What is wrong with JSON, for messages.

#include <exception>
#include <string>

namespace coseg {

/// What an exception of the JSON library says, without its number. Of the text that it read last it keeps the
/// end, at most 80 bytes and all of them printable, as that text may be the whole rest of the file.
std::string json_failure(const std::exception& failure);

}  // namespace coseg

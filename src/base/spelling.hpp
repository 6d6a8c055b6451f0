#pragma once
// Which word a misspelt one was meant to be.

#include <string>
#include <vector>

namespace coseg {

/// Letters to insert, delete or replace, to make one word of the other. Source: Levenshtein 1966.
int edit_distance(const std::string& a, const std::string& b);

/// The candidate nearest to `word`, the first of several; empty if none is near enough to be meant: more than a third
/// of the longer word's letters differ (but two always may).
std::string nearest_word(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace coseg

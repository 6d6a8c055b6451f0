#pragma once
// Finds the word that a misspelt one was meant to be.

#include <string>
#include <vector>

namespace coseg {

/// The number of letters to insert, delete or replace to make one word of the other. Source: Levenshtein
/// 1966.
int edit_distance(const std::string& a, const std::string& b);

/// The candidate nearest to `word`, and the first of several. It is empty if no candidate is near enough: if
/// more than a third of the longer word's letters differ (but two always may).
std::string nearest_word(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace coseg

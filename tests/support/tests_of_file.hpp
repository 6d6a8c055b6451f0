#pragma once
// One executable holds the tests of many sources, as linking and starting a program cost more than most
// tests; CTest names them by source.

/// Keeps to the tests of one source if the arguments hold `--tests-of NAME`, NAME being the end of the
/// source's path, as solvers/kmeans/shape_words_test.cpp, and takes these two arguments away. Call it after
/// testing::InitGoogleTest. Returns false, and says so, if there are none.
bool choose_tests_of_file(int& argc, char** argv);

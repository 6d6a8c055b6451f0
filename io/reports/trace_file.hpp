#pragma once
// Traces that Perfetto (ui.perfetto.dev) and Chrome (chrome://tracing) open.

#include <string>
#include <vector>

#include "src/parallel/trace_event.hpp"

namespace coseg {

/// Writes the spans of all ranks as trace events in JSON: one process a rank, one complete event ("ph": "X")
/// a span, start and duration in microseconds, longest first among those that start together, so that each
/// encloses what follows. Throws Error(output) if the file cannot be written. Source: "Trace Event Format" of
/// the Chromium project, JSON Object Format.
void write_trace(const std::string& path, const std::vector<RankTrace>& ranks);

}  // namespace coseg

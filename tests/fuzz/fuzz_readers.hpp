// fuzz_readers.hpp: what the fuzz targets and the replay of their finds do with a text or file from anywhere. Each
// function takes any bytes; it must come back, and what was accepted must hold what the reader promises.
#pragma once

#include <string>

namespace wedge::fuzz {

/// A scene file. Accepted: it must read back from its resolved form to the same.
void scene(const std::string& bytes);

/// The tables and small files that wedge reads back: the first byte says which of them the rest is.
void csv(const std::string& bytes);

/// What stands behind the head of a checkpoint; the head is made to fit. Accepted: all indices are followed.
/// The first byte says which: 'h' the HDF5 file itself follows, 'p' changes to the bytes of a good file; else
/// changes to the numbers of a good state (see there).
void checkpoint(const std::string& bytes);

}  // namespace wedge::fuzz

// fuzz_readers.hpp: what the fuzz targets and the replay of their finds do with a text or file from anywhere. Each
// function takes any bytes; it must come back, and what was accepted must hold what the reader promises.
#pragma once

#include <string>

namespace wedge::fuzz {

/// A scene file. Accepted: it must read back from its resolved form to the same.
void scene(const std::string& bytes);

/// The tables and small files that wedge reads back: the first byte says which of them the rest is.
void csv(const std::string& bytes);

/// A good state with any of its numbers and lengths changed, written as a checkpoint and read. Accepted: all
/// indices are followed.
void checkpoint(const std::string& bytes);

/// What stands behind the head of a checkpoint, whose checksum is made to fit. The first byte says which: 'h' the
/// HDF5 file itself follows, else changes to single bytes of a good file. libhdf5 itself reads memory that is not
/// its own in some of them: a find counts when it is in wedge.
void checkpoint_bytes(const std::string& bytes);

}  // namespace wedge::fuzz

// precompiled.cpp: empty; CMake makes the precompiled header of the tests for it.

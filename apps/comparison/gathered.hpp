// gathered.hpp: one result of every run and wedge of two sets, where they have it.
#pragma once

#include <string>
#include <vector>

#include "apps/comparison/observables.hpp"

namespace wedge {

template <class T>
struct Gathered {
  struct Reference {
    const T* whole = nullptr;  // nullptr: the run has none
    std::vector<const T*> wedges;
  };
  std::vector<Reference> reference;  // of every run
  std::vector<const T*> compared;    // of those that have it
};

/// `find(run, part)` gives the result or nullptr.
template <class T, class Find>
Gathered<T> gather(const RunSets& sets, Find find) {
  Gathered<T> gathered;
  for (const RunResults& run : sets.reference) {
    typename Gathered<T>::Reference one;
    one.whole = find(run, "whole");
    for (const std::string& wedge : run.wedges)
      if (const T* found = find(run, wedge)) one.wedges.push_back(found);
    gathered.reference.push_back(std::move(one));
  }
  for (const RunResults& run : sets.compared)
    if (const T* found = find(run, "whole")) gathered.compared.push_back(found);
  return gathered;
}

/// Puts what was gathered into an observable; `sample` makes a Sample of a result.
template <class T, class MakeSample>
void put_samples(const Gathered<T>& gathered, MakeSample sample, Observable& o) {
  for (const auto& run : gathered.reference) {
    if (!run.whole) continue;
    o.reference.push_back(sample(run.whole));
    std::vector<Sample> wedges;
    for (const T* wedge : run.wedges) wedges.push_back(sample(wedge));
    o.wedges.push_back(std::move(wedges));
  }
  for (const T* run : gathered.compared) o.compared.push_back(sample(run));
}

}  // namespace wedge

// Which Instance serves which mjData.
//
// The pointer is not kept in mjData.plugin_data: pickling copies that number into other mjData, even
// into other processes, where it would point to nothing.
#pragma once

#include <mujoco/mujoco.h>

#include <map>
#include <memory>
#include <mutex>
#include <shared_mutex>
#include <utility>

#include "instance.hpp"

namespace flaprig {

class Registry {
 public:
  // nullptr when there is none
  Instance* find(const mjData* d, int id) const {
    const std::shared_lock lock(mutex_);
    const auto found = instances_.find({d, id});
    return found == instances_.end() ? nullptr : found->second.get();
  }
  void put(const mjData* d, int id, std::unique_ptr<Instance> instance) {
    const std::unique_lock lock(mutex_);
    instances_[{d, id}] = std::move(instance);
  }
  void remove(const mjData* d, int id) {
    const std::unique_lock lock(mutex_);
    instances_.erase({d, id});
  }

 private:
  mutable std::shared_mutex mutex_;
  std::map<std::pair<const mjData*, int>, std::unique_ptr<Instance>> instances_;
};

// never destroyed: mjData may outlive this library's statics
inline Registry& registry() {
  static Registry& all = *new Registry;
  return all;
}

}  // namespace flaprig

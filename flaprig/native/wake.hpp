// The lattice's memory as a view of plain numbers, so that MuJoCo can own, copy and save it.
#pragma once

#include "vec3.hpp"

namespace flaprig {

// All that the unsteady lattice remembers. Zeros are a valid, wake-free beginning.
// Names with _n belong to the last wake tick, those with _p to the one before.
struct Wake {
  // sizes
  int panels, strips, capacity;  // bound rings, rings a row, frozen rows at most
  bool lags;                     // whether lagged() is there

  double* data;

  static int state_size(int panels, int strips, int capacity, bool lags) {
    return kHeader + (lags ? 10 : 8) * panels + (capacity + 1) * (strips + 1) * 3 +
           capacity * strips;
  }

  double& started() { return data[0]; }   // 0 before the first tick
  double& age() { return data[1]; }       // time since the last tick [s]
  double& interval() { return data[2]; }  // between the last two ticks [s]
  double& rows() { return data[3]; }      // frozen rows of rings; vertex rows are one more
  double* pose() { return data + 4; }     // at the last tick: position, rotation

  double* circulation() { return data + kHeader; }                // bound, at the last tick
  double* memory_n() { return circulation() + panels; }           // wake's part of it: Gw
  double* memory_p() { return memory_n() + panels; }
  double* rate_p() { return memory_p() + panels; }                // (Gw_p - Gw_pp)/interval
  double* stream_n() { return rate_p() + panels; }                // in-plane wake velocity, x y
  double* stream_p() { return stream_n() + 2 * panels; }
  double* vertices() { return stream_p() + 2 * panels; }          // newest row first, world [m]
  double* lagged_n() { return strengths() + capacity * strips; }  // circulation that has built up
  double* lagged_p() { return lagged_n() + panels; }
  double* strengths() { return vertices() + (capacity + 1) * (strips + 1) * 3; }

  Vec3 vertex(int row, int j) const;
  void set_vertex(int row, int j, Vec3 p);
  // makes room for a new first row; the oldest falls off when the wake is full
  void push_row(const double* row_strengths);
  void clear();

 private:
  static constexpr int kHeader = 16;
};

}  // namespace flaprig

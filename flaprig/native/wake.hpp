// The lattice's memory as a view of plain numbers, so that MuJoCo can own, copy and save it.
#pragma once

#include <string>

#include "vec3.hpp"

namespace flaprig {

// All that the unsteady lattice remembers. Zeros are a valid, wake-free beginning. Whoever owns the
// numbers may write into them: before any of them is used as a count or a place, fault() must be empty.
// Names with _n belong to the last wake tick, those with _p to the one before.
struct Wake {
  // sizes
  int panels, strips, capacity;  // bound rings, rings a row, frozen rows at most
  int longest, detail;           // ticks that are kept; ticks that a vertex row is young, 0: for ever
  bool lags;                     // whether lagged() is there

  double* data;

  Wake(int panels, int strips, int longest, int detail, bool lags, double* data);
  int state_size() const {
    return kHeader + (lags ? 10 : 8) * panels + (capacity + 1) * stride() +
           capacity * (strips + 1) + old_rows() * (2 * stride() + 1);
  }
  int stride() const { return 3 * (strips + 1); }  // numbers in a vertex row
  // vertex rows that are not young, at most
  int old_rows() const { return detail > 0 ? capacity + 1 - detail : 0; }

  // ticks between two findings of an old row's far velocity at most: the wake beyond is tangled, and
  // what is extrapolated over more of them flings it apart
  static constexpr int kLongestPause = 4;

  // the first of the counts and times that no run leaves behind, as a clause; empty where there is none
  std::string fault() const;

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
  double* ticks() { return strengths() + capacity * strips; }     // that a row was shed in
  double* lagged_n() { return ticks() + capacity; }               // circulation that has built up
  double* lagged_p() { return lagged_n() + panels; }
  double* strengths() { return vertices() + (capacity + 1) * stride(); }
  // of a vertex row that is not young: its velocity by all but the newest rows and the wing, when it
  // was last found [m/s]; what that had changed by, per tick; how many ticks ago, 0 where never
  double* far(int row) { return lagged_n() + (lags ? 2 : 0) * panels + (row - detail) * stride(); }
  double* drift(int row) { return far(row + old_rows()); }
  double& found(int row) { return drift(detail + old_rows())[row - detail]; }

  Vec3 vertex(int row, int j) const;
  void set_vertex(int row, int j, Vec3 p);
  // makes room for a new first row, drops what is too old and merges what is old
  void push_row(const double* row_strengths);
  void clear();

 private:
  double area(int row, int strip) const;
  void age_old(int last);
  void drop_oldest();
  void merge_old();
  void merge(int row);
  std::string fault_of_clock() const;
  std::string fault_of_ticks() const;
  std::string fault_of_found() const;
  static constexpr int kHeader = 16;
};

}  // namespace flaprig

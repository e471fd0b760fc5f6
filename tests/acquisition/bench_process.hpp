// SPDX-License-Identifier: BSD-3-Clause
// A simulated bench in a process of its own, on a virtual clock of its own.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include "tests/acquisition/test_bench.hpp"

namespace gonio::acquisition::test {

/// The bench in another process, with a virtual clock of its own, until it is told to end.
class BenchProcess {
 public:
  explicit BenchProcess(Bench bench) : bench_(std::move(bench)) {
    int to_child[2], to_parent[2];
    if (pipe(to_child) != 0 || pipe(to_parent) != 0) throw Error(ErrorKind::internal, Fault{"pipe", "no pipe", "a pipe"});
    pid_ = fork();
    if (pid_ == 0) {
      close(to_child[1]);
      {
        const simulated::SimulatedBench simulated(bench_, sample(), std::make_shared<VirtualClock>());
        const auto ports = simulated.ports();
        char end = 0;
        if (write(to_parent[1], &ports, sizeof ports) == sizeof ports) (void)!read(to_child[0], &end, 1);
      }
      _exit(0);
    }
    close(to_child[0]);
    close(to_parent[1]);
    lifeline_ = to_child[1];
    simulated::SimulatedBench::Ports ports;
    if (read(to_parent[0], &ports, sizeof ports) != sizeof ports)
      throw Error(ErrorKind::internal, Fault{"bench process", "it did not start", "its ports"});
    close(to_parent[0]);
    bench_.modbus.port = ports.modbus;
    bench_.scpi.port = ports.scpi;
  }
  ~BenchProcess() {
    close(lifeline_);
    waitpid(pid_, nullptr, 0);
  }
  const Bench& bench() const { return bench_; }

 private:
  Bench bench_;
  pid_t pid_ = -1;
  int lifeline_ = -1;
};

}  // namespace gonio::acquisition::test

// SPDX-License-Identifier: BSD-3-Clause
// Benches and plans that cannot work: the documented exit code, a message that says where, and nothing half-written.
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <fmt/format.h>

#include "data-schemas/document.hpp"
#include "tests/command.hpp"

#include "tests/check.hpp"

using namespace gonio;
using test::run_gonio;

namespace {

/// A loopback port: with somebody who listens and never answers, or with nobody.
class Port {
 public:
  explicit Port(bool listening) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    REQUIRE(bind(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0);
    socklen_t length = sizeof address;
    getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &length);
    number_ = ntohs(address.sin_port);
    if (listening) REQUIRE(listen(socket_, 8) == 0);
  }
  ~Port() { close(socket_); }
  Port(const Port&) = delete;
  Port& operator=(const Port&) = delete;
  int number() const { return number_; }

 private:
  int socket_, number_ = 0;
};

struct Files {
  test::TemporaryFolder folder;
  Files() {
    test::write_file(folder / "bench.json", std::string(example_text("demo.bench.json")));
    test::write_file(folder / "plan.json", std::string(example_text("demo.plan.json")));
  }
  std::string path(const std::string& name) const { return fmt::format("'{}'", (folder / name).string()); }
  std::string sweep() const {
    return "sweep " + path("plan.json") + " --bench " + path("bench.json") + " --out " + path("run.gonio") + " --quiet ";
  }
};

}  // namespace

TEST_CASE("a bench that refuses the connection exits 5 and names the port") {
  const Files files;
  const Port nobody(false);
  const auto outcome =
      run_gonio(files.sweep() + fmt::format("--modbus 127.0.0.1:{} --scpi 127.0.0.1:{}", nobody.number(), nobody.number()));
  INFO(outcome.err);
  CHECK(outcome.code == 5);
  CHECK(outcome.err.find(std::to_string(nobody.number())) != std::string::npos);
}

TEST_CASE("a bench that does not answer exits 5 after its time-out") {
  const Files files;
  const Port silent(true);
  const auto outcome =
      run_gonio(files.sweep() + fmt::format("--modbus 127.0.0.1:{} --scpi 127.0.0.1:{}", silent.number(), silent.number()));
  INFO(outcome.err);
  CHECK(outcome.code == 5);
  CHECK(outcome.err.find(std::to_string(silent.number())) != std::string::npos);
}

TEST_CASE("a port in use exits 5 and names it") {
  const Files files;
  const Port taken(true);
  Json bench = parse_json(example_text("demo.bench.json"), "bench");
  Json connections = bench.at("connections"), modbus = connections.at("modbus");
  modbus.set("port", taken.number());
  connections.set("modbus", modbus);
  bench.set("connections", connections);
  test::write_file(files.folder / "bench.json", bench.dump());
  const auto outcome = run_gonio("serve " + files.path("bench.json"));
  INFO(outcome.err);
  CHECK(outcome.code == 5);
  CHECK(outcome.out.empty());
  CHECK(outcome.err.find(std::to_string(taken.number())) != std::string::npos);
}

TEST_CASE("a plan with unreachable points exits 4 naming them, before anything moves or is written") {
  const Files files;
  Json bench = parse_json(example_text("demo.bench.json"), "bench");
  Json axes = Json::array();
  for (const Json& axis : bench.at("axes").elements()) {
    Json copy = axis;
    if (axis.at("name").string() == "light") {
      copy.set("lower_deg", -40);
      copy.set("upper_deg", 40);
    }
    axes.push_back(copy);
  }
  bench.set("axes", axes);
  test::write_file(files.folder / "bench.json", bench.dump());
  for (const std::string& verb : {files.sweep(), "plan " + files.path("plan.json") + " --bench " + files.path("bench.json")}) {
    const auto outcome = run_gonio(verb);
    INFO(outcome.err);
    CHECK(outcome.code == 4);
    CHECK(outcome.err.find("light") != std::string::npos);
    CHECK(outcome.err.find("40") != std::string::npos);
  }
  CHECK_FALSE(std::filesystem::exists(files.folder / "run.gonio"));
  CHECK(run_gonio("plan " + files.path("plan.json") + " --bench " + files.path("bench.json") + " --skip-unreachable").code == 0);
}

TEST_CASE("a schema fault exits 3 with its JSON pointer, and nothing is written") {
  const Files files;
  Json plan = parse_json(example_text("demo.plan.json"), "plan");
  plan.set("rotations", "many");
  plan.set("speed", 3);
  test::write_file(files.folder / "plan.json", plan.dump());
  const auto outcome = run_gonio(files.sweep());
  INFO(outcome.err);
  CHECK(outcome.code == 3);
  CHECK(outcome.err.find("#/rotations") != std::string::npos);
  CHECK(outcome.err.find("speed") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(files.folder / "run.gonio"));
}

TEST_CASE("an existing run is neither overwritten nor resumed with another plan") {
  const Files files;
  REQUIRE(run_gonio(files.sweep()).code == 0);
  const std::string before = sha256_of_file(files.folder / "run.gonio");
  CHECK(run_gonio(files.sweep()).code == 3);
  Json plan = parse_json(example_text("demo.plan.json"), "plan");
  plan.set("name", "another");
  test::write_file(files.folder / "plan.json", plan.dump());
  CHECK(run_gonio(files.sweep() + "--resume").code == 3);
  CHECK(sha256_of_file(files.folder / "run.gonio") == before);
}

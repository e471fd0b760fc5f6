// SPDX-License-Identifier: BSD-3-Clause
// The emulated meter's language, and the driver against it and against a meter that misbehaves.
#include "acquisition/simulated/power_meter.hpp"

#include <sys/socket.h>

#include <mutex>
#include <random>

#include "acquisition/scpi_power_meter.hpp"
#include "acquisition/simulated/listener.hpp"
#include "tests/acquisition/test_bench.hpp"
#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::acquisition;
using namespace gonio::acquisition::test;

namespace {

struct Meter {
  std::shared_ptr<VirtualClock> clock = std::make_shared<VirtualClock>();
  double signal = 1.25e-6;
  simulated::PowerMeter meter{ideal_bench(), clock, [this](BenchTime, double) { return signal; }};
  std::string ask(const std::string& line) { return meter.execute(line).value_or("(nothing)"); }
};

/// Answers each line by a script; an empty answer means silence.
class ScriptedMeter {
 public:
  explicit ScriptedMeter(std::function<std::string(const std::string&)> answer)
      : listener_(Endpoint{"127.0.0.1", 0}, [answer = std::move(answer)](int socket) {
          std::string received;
          char buffer[512];
          for (ssize_t n; (n = recv(socket, buffer, sizeof buffer, 0)) > 0;) {
            received.append(buffer, static_cast<std::size_t>(n));
            for (auto end = received.find('\n'); end != std::string::npos; end = received.find('\n')) {
              const std::string reply = answer(received.substr(0, end));
              received.erase(0, end + 1);
              if (!reply.empty()) send(socket, reply.data(), reply.size(), MSG_NOSIGNAL);
            }
          }
        }) {}
  Endpoint endpoint() const { return {"127.0.0.1", listener_.port()}; }

 private:
  simulated::Listener listener_;
};

std::string what(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& e) {
    CHECK(e.kind() == ErrorKind::device);
    return e.what();
  }
  FAIL("no error");
  return {};
}

}  // namespace

TEST_CASE("Short and long forms in any case are understood, and nothing in between") {
  Meter m;
  for (const char* line :
       {"SENS:CORR:WAV 632.8", "sense:correction:wavelength 632.8", ":Sens:Corr:Wav +6.328E2", "SENSE:CORR:WAVELENGTH 632.8"}) {
    m.ask("SENS:CORR:WAV 500");
    CHECK(m.ask(line) == "(nothing)");
    CHECK(std::stod(m.ask("SENS:CORR:WAV?")) == 632.8);
  }
  CHECK(m.ask("SYST:ERR?") == "0,\"No error\"");
  m.ask("SENS:CORR:WAVEL 500");
  CHECK(m.ask("SYST:ERR?") == "-113,\"Undefined header\"");
  CHECK(m.ask("SYST:ERR?") == "0,\"No error\"");
}

TEST_CASE("Commands joined by semicolons keep the path and their answers are joined") {
  Meter m;
  CHECK(m.ask("SENS:CORR:WAV 700;WAV?;:SYST:ERR?") == "7.0000000000000000E+02;0,\"No error\"");
  CHECK(m.ask("*IDN?").starts_with("GONIO,"));
}

TEST_CASE("Wrong commands queue the errors of the standard and change nothing") {
  Meter m;
  const std::string before = m.ask("SENS:CORR:WAV?");
  for (const auto& [line, error] : std::vector<std::pair<std::string, std::string>>{{"SENS:CORR:WAV 1e9", "-222"},
                                                                                    {"SENS:CORR:WAV nan", "-104"},
                                                                                    {"SENS:CORR:WAV", "-109"},
                                                                                    {"SENS:CORR:WAV? 5", "-108"},
                                                                                    {"*IDN", "-113"},
                                                                                    {"NONSENSE", "-113"}}) {
    m.ask(line);
    CAPTURE(line);
    CHECK(m.ask("SYST:ERR?").starts_with(error));
  }
  CHECK(m.ask("FETC?") == "9.91E37");
  CHECK(m.ask("SYST:ERR?").starts_with("-230"));
  m.meter.interrupted();
  m.meter.unterminated();
  CHECK(m.ask("SYST:ERR?").starts_with("-410"));
  CHECK(m.ask("SYST:ERR?").starts_with("-420"));
  CHECK(m.ask("SENS:CORR:WAV?") == before);
  for (int k = 0; k < 100; ++k) m.ask("NONSENSE");
  std::string last;
  for (std::string e = m.ask("SYST:ERR?"); !e.starts_with("0,"); e = m.ask("SYST:ERR?")) last = e;
  CHECK(last.starts_with("-350"));
}

TEST_CASE("A reading takes its exposure, is printed with every digit, and beyond the range is infinite") {
  Meter m;
  m.signal = 1.0 / 3e6;
  m.ask("SENS:AVER:COUN 1000");
  m.ask("INIT");
  CHECK(m.clock->now() == 0);
  CHECK(std::stod(m.ask("FETC?")) == m.signal);
  CHECK(m.clock->now() == bench_time(0.3));
  CHECK(std::stod(m.ask("FETC?")) == m.signal);  // the same reading again
  m.ask("SENS:POW:RANG:UPP 1e-7;:INIT");
  CHECK(m.ask("FETC?") == "9.9E37");
}

TEST_CASE("Mutated commands never break the meter") {
  Meter m;
  const std::string seeds[] = {"SENS:CORR:WAV 632.8;WAV?", ":SYST:ERR?;*CLS", "INIT;FETC?", "SENS:POW:RANG:UPP MAX;UPP?", "*IDN?;*RST"};
  constexpr unsigned seed = 11;
  std::mt19937 random(seed);
  for (int k = 0; k < 5000; ++k) {
    std::string line = seeds[random() % std::size(seeds)];
    for (int n = 0; n < 1 + k % 4; ++n) line[random() % line.size()] = static_cast<char>(random());
    if (k % 3 == 0) line.resize(random() % line.size());
    m.meter.execute(line);
  }
  m.ask("*CLS");
  CHECK(m.ask("SYST:ERR?") == "0,\"No error\"");
}

TEST_CASE("The driver refuses another instrument by its identity") {
  const EmbeddedBench b(ideal_bench());
  CHECK(what([&] { ScpiPowerMeter(b.bench.scpi, "THORLABS,PM100D"); }).find("THORLABS,PM100D") != std::string::npos);
}

TEST_CASE("Two queries in one packet interrupt the first") {
  const EmbeddedBench b(ideal_bench());
  TcpStream stream(b.bench.scpi, 5);
  stream.send_line("*IDN?\nSYST:ERR?", 5);
  CHECK(stream.receive_line(5).starts_with("-410"));
}

TEST_CASE("A driver takes no number from a meter that misbehaves") {
  std::mutex mutex;  // the meter answers on a thread of its own
  std::string wavelength = "550", fetched = "1e-6", errors = "0,\"No error\"\n";
  const auto set = [&](std::string& text, const std::string& value) {
    const std::lock_guard lock(mutex);
    text = value;
  };
  const ScriptedMeter scripted([&](const std::string& line) -> std::string {
    const std::lock_guard lock(mutex);
    if (line == "*IDN?") return "SCRIPTED\n";
    if (line == "SYST:ERR?") return errors;
    if (line == "SENS:CORR:WAV?") return wavelength + "\n";
    if (line == "SENS:POW:RANG:UPP?") return "0.001\n";
    if (line == "SENS:AVER:COUN?") return "333\n";
    if (line == "FETC?") return fetched.empty() ? "" : fetched + "\n";
    return "";
  });
  ScpiPowerMeter meter(scripted.endpoint(), "SCRIPTED", 0.1);
  meter.configure(550, 1e-3, 0.1);
  CHECK(meter.read(0.1) == 1e-6);
  for (const char* garbage : {"nan", "", "1e-6x", "-", "9.9E37", "9.91E37", "1,2"}) {
    set(fetched, garbage);
    CAPTURE(garbage);
    what([&] { meter.read(0.1); });
  }
  set(fetched, "2e-6");
  CHECK(meter.read(0.1) == 2e-6);  // the connection was opened and configured anew
  set(wavelength, "551");
  CHECK(what([&] { meter.configure(550, 1e-3, 0.1); }).find("551") != std::string::npos);
  set(wavelength, "550");
  set(errors, "-222,\"Data out of range\"\n");
  CHECK(what([&] { meter.configure(550, 1e-3, 0.1); }).find("-222") != std::string::npos);
}

TEST_CASE("A meter that is not there is named by host and port") {
  int port = 0;
  {
    port = simulated::Listener({"127.0.0.1", 0}, [](int) {}).port();
  }
  CHECK(what([&] { ScpiPowerMeter({"127.0.0.1", port}, ""); }).find("127.0.0.1:" + std::to_string(port)) != std::string::npos);
}

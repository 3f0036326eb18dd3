// steer.cpp: a session in C++ with a global variable that the program changes in each frame.
//
//   c++ -std=c++17 steer.cpp -o steer $(pkg-config --cflags --libs petri) && ./steer
#include <cstdio>
#include <memory>
#include <petri.h>
#include <stdexcept>
#include <string>
#include <string_view>

namespace {

struct Close {
    void operator()(PetriSession *session) const {
        petri_close(&session);
    }
};

// Owns a session. Throws std::runtime_error with the diagnostics if a call fails.
class Session {
  public:
    Session() {
        PetriOptions options = petri_default_options();
        session_.reset(petri_open(&options));
        if (!session_)
            throw std::bad_alloc();
    }
    void load(std::string_view script) {
        check(petri_load_text(get(), "steer.fl", script.data(), script.size()));
    }
    void give(const char *name, double number) {
        check(petri_set_global(get(), name, {1, &number, nullptr}));
    }
    void step() {
        check(petri_step(get()));
    }
    PetriSystem system(size_t number) const {
        PetriSystem system;
        if (!petri_system(get(), number, &system, sizeof system))
            throw std::out_of_range("no such system");
        return system;
    }
    PetriSession *get() const {
        return session_.get();
    }

  private:
    void check(PetriStatus status) const {
        if (status == PETRI_OK)
            return;
        std::string text = petri_status_text(status);
        PetriDiagnostic diagnostic;
        for (size_t i = 0; petri_diagnostic(get(), i, &diagnostic, sizeof diagnostic); i++)
            text += std::string("\n") + diagnostic.rendered;
        throw std::runtime_error(text);
    }
    std::unique_ptr<PetriSession, Close> session_;
};

constexpr std::string_view script = "!physics state=:boat dimensions=2 time=time resolution=1/60\n"
                                    "    !particle id=1 force=10*polar(rudder)\n";

} // namespace

int main() try {
    Session session;
    session.give("rudder", 0);
    session.load(script);
    for (int frame = 0; frame <= 240; frame++) {
        session.give("rudder", frame / 240.0);
        session.step();
        if (frame % 60 == 0) {
            const PetriSystem boat = session.system(0);
            std::printf("%3d: %7.3f %7.3f\n", frame, boat.position.data[0], boat.position.data[1]);
        }
    }
    return 0;
} catch (const std::exception &problem) {
    std::fprintf(stderr, "steer: %s\n", problem.what());
    return 1;
}

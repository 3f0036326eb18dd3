// engine_names.h: the names that the engine defines for the main program (spec language.md L16.1).
//
// ENGINE_NAME(ID, "name", static). `static`: true if the value is constant during a run (L17.2).
// clang-format off
ENGINE_NAME(FRAME,       "frame",       false)
ENGINE_NAME(FPS,         "fps",         false)
ENGINE_NAME(TIME,        "time",        false)
ENGINE_NAME(BEAT,        "beat",        false)
ENGINE_NAME(DELTA,       "delta",       false)
ENGINE_NAME(TEMPO,       "tempo",       false)
ENGINE_NAME(QUANTUM,     "quantum",     false)
ENGINE_NAME(PERFORMANCE, "performance", false)
ENGINE_NAME(SLOW_FRAME,  "slow_frame",  false)
ENGINE_NAME(CLOCK,       "clock",       false)
ENGINE_NAME(REALTIME,    "realtime",    true)
ENGINE_NAME(RUN_TIME,    "run_time",    true)
ENGINE_NAME(SCREEN,      "screen",      true)
ENGINE_NAME(FULLSCREEN,  "fullscreen",  true)
ENGINE_NAME(VSYNC,       "vsync",       true)
ENGINE_NAME(OFFSCREEN,   "offscreen",   true)
ENGINE_NAME(OPENGL_ES,   "opengl_es",   true)
// clang-format on

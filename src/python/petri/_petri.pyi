# What cffi makes: its names are those of petri.h.
from typing import Any

ffi: Any
lib: Any

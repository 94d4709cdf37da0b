# Cortex-M7 without an operating system, on the emulated board mps2-an500.
set(ISOLOD_BOARD_FLAGS "-mcpu=cortex-m7 -mfpu=fpv5-d16")
set(ISOLOD_BOARD_MACHINE mps2-an500)
include(${CMAKE_CURRENT_LIST_DIR}/board.cmake)

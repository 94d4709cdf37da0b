# Cortex-M4 without an operating system, on the emulated board mps2-an386.
set(ISOLOD_BOARD_FLAGS "-mcpu=cortex-m4 -mfpu=fpv4-sp-d16")
set(ISOLOD_BOARD_MACHINE mps2-an386)
include(${CMAKE_CURRENT_LIST_DIR}/board.cmake)

# Cortex-M55 without an operating system, on the emulated board mps3-an547.
set(ISOLOD_BOARD_FLAGS "-mcpu=cortex-m55 -mfpu=auto")
set(ISOLOD_BOARD_MACHINE mps3-an547)
include(${CMAKE_CURRENT_LIST_DIR}/board.cmake)

# What the toolchain files of the boards share. No start files, and no system calls: whatever needs a heap or files does
# not link.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR arm)
set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)  # nothing can be linked before the board's files are there
set(ISOLOD_BOARD_FOLDER ${CMAKE_CURRENT_LIST_DIR}/../board)
set(CMAKE_CXX_FLAGS_INIT
  "${ISOLOD_BOARD_FLAGS} -mthumb -mfloat-abi=hard -DISOLOD_BOARD -fno-exceptions -fno-rtti -fno-threadsafe-statics")
string(APPEND CMAKE_CXX_FLAGS_INIT " -fno-use-cxa-atexit -ffunction-sections -fdata-sections")
set(CMAKE_EXE_LINKER_FLAGS_INIT
  "-nostartfiles -Wl,--gc-sections -L${ISOLOD_BOARD_FOLDER} -T${ISOLOD_BOARD_FOLDER}/${ISOLOD_BOARD_MACHINE}.ld")
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-system-arm -M ${ISOLOD_BOARD_MACHINE} -nographic -monitor none -serial none
  -semihosting-config enable=on,target=native -kernel)

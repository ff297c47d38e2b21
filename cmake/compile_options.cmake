add_library(solidus_options INTERFACE)
target_compile_features(solidus_options INTERFACE cxx_std_20)
# Whoever links the installed libraries gets their headers and what they must share with them, and keeps warnings of his own.
target_include_directories(solidus_options INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>
                           $<INSTALL_INTERFACE:include/solidus>)
target_compile_options(solidus_options INTERFACE
                       $<BUILD_INTERFACE:-Wall;-Wextra;-Wpedantic;-Wshadow;-Wconversion;-Werror>
                       -Wno-psabi
                       $<BUILD_INTERFACE:$<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>> # false positives of g++ 12 on std::string (GCC bug 105651)
                       $<BUILD_INTERFACE:-fno-math-errno;-fno-trapping-math>)
# The same objects serve the program and the Python module, which is a shared library. Calls within a file are inlined as without it;
# in the program the linker turns the detours over tables of addresses back into direct ones.
target_compile_options(solidus_options INTERFACE $<BUILD_INTERFACE:-fPIC;-fno-semantic-interposition>)
target_compile_definitions(solidus_options INTERFACE OMPI_SKIP_MPICXX)
if(SOLIDUS_MARCH)
  target_compile_options(solidus_options INTERFACE -march=${SOLIDUS_MARCH})
endif()
# What is handed out names no folder of the machine that built it: the same commit gives the same bytes wherever it lies. (In
# CMAKE_CXX_FLAGS a folder with a blank in its name would be two words.)
if(NOT SOLIDUS_KNOWS_SOURCES)
  add_compile_options(-ffile-prefix-map=${PROJECT_SOURCE_DIR}/=)
endif()
if(SOLIDUS_SANITIZE)
  # clang inlines nothing at -O1 that need not be; -O2 takes a tenth longer to compile.
  target_compile_options(solidus_options INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all
                         -fno-omit-frame-pointer -O2)
  target_link_options(solidus_options INTERFACE -fsanitize=address,undefined)
endif()

# gold, which comes with Debian 12's binutils, links a test program in 0.1 s where the default linker takes 0.8, and some thirty programs
# are linked again whenever a room changes. Binutils 2.44 (Debian 13) has it no more; the default linker makes the same programs.
if(NOT SOLIDUS_SANITIZE)
  include(CheckLinkerFlag)
  check_linker_flag(CXX -fuse-ld=gold SOLIDUS_LINKS_WITH_GOLD)
  if(SOLIDUS_LINKS_WITH_GOLD)
    add_link_options(-fuse-ld=gold)
  endif()
endif()

add_library(solidus_options INTERFACE)
target_compile_features(solidus_options INTERFACE cxx_std_20)
target_include_directories(solidus_options INTERFACE ${PROJECT_SOURCE_DIR}/src)
target_compile_options(solidus_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror -Wno-psabi
                       -fno-math-errno -fno-trapping-math)
target_compile_definitions(solidus_options INTERFACE SOLIDUS_VERSION="${PROJECT_VERSION}" OMPI_SKIP_MPICXX)
if(SOLIDUS_MARCH)
  target_compile_options(solidus_options INTERFACE -march=${SOLIDUS_MARCH})
endif()
if(SOLIDUS_SANITIZE)
  target_compile_options(solidus_options INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all
                         -fno-omit-frame-pointer -O1)
  target_link_options(solidus_options INTERFACE -fsanitize=address,undefined)
endif()

# The core: cargo builds rust/polycube-cxx as a static library with the headers of the bridge.
#
# Sets POLYCUBE_BRIDGE_INCLUDE, the include directories of the bridge, and defines the targets polycube_core (to link)
# and polycube_core_build (to depend on).
find_program(POLYCUBE_CARGO cargo HINTS $ENV{CARGO_HOME}/bin $ENV{HOME}/.cargo/bin REQUIRED DOC "cargo, 1.95 or later")

get_filename_component(root "${CMAKE_CURRENT_SOURCE_DIR}/.." ABSOLUTE)
if(DEFINED ENV{CARGO_TARGET_DIR})
  set(default "$ENV{CARGO_TARGET_DIR}")
else()
  set(default "${root}/target")
endif()
set(POLYCUBE_CARGO_TARGET_DIR "${default}" CACHE PATH "Where cargo builds; shared with other builds of this source tree")
set(POLYCUBE_CARGO_PROFILE release CACHE STRING "Profile of the core: release, or dev for quick builds")
set_property(CACHE POLYCUBE_CARGO_PROFILE PROPERTY STRINGS release dev)

option(POLYCUBE_CARGO_TESTED "Build the core as the tests of the workspace do, which so need not be compiled again" OFF)

# Cargo compiles packages again that get other features, which all packages that are built together decide.
if(POLYCUBE_CARGO_TESTED)
  set(build build --manifest-path "${root}/Cargo.toml" --workspace --exclude polycube-py --lib --bins --tests)
else()
  set(build rustc --manifest-path "${root}/rust/polycube-cxx/Cargo.toml" --lib --crate-type staticlib)
endif()

string(REPLACE "dev" "debug" folder "${POLYCUBE_CARGO_PROFILE}")
set(built "${POLYCUBE_CARGO_TARGET_DIR}/${folder}/libpolycube_cxx.a")
set(header "${POLYCUBE_CARGO_TARGET_DIR}/cxxbridge/polycube-cxx/src/lib.rs.h")
set(bridge "${CMAKE_CURRENT_BINARY_DIR}/bridge")
set(POLYCUBE_CORE_ARCHIVE "${CMAKE_CURRENT_BINARY_DIR}/libpolycube_core.a")
set(POLYCUBE_BRIDGE_INCLUDE "${bridge}" "${root}/rust")

file(GLOB_RECURSE sources CONFIGURE_DEPENDS "${root}/rust/polycube/src/*.rs" "${root}/rust/polycube-host/src/*.rs"
     "${root}/rust/polycube-cxx/src/*.rs" "${root}/rust/polycube-cxx/include/*.h")
add_custom_command(
  OUTPUT "${POLYCUBE_CORE_ARCHIVE}" "${bridge}/polycube-cxx/src/lib.rs.h" "${bridge}/rust/cxx.h"
  COMMAND "${CMAKE_COMMAND}" -E env "CARGO_TARGET_DIR=${POLYCUBE_CARGO_TARGET_DIR}" "${POLYCUBE_CARGO}" ${build} --quiet
          --locked --profile "${POLYCUBE_CARGO_PROFILE}"
  COMMAND "${CMAKE_COMMAND}" -E copy "${built}" "${POLYCUBE_CORE_ARCHIVE}"
  COMMAND "${CMAKE_COMMAND}" -E make_directory "${bridge}/polycube-cxx/src" "${bridge}/rust"
  COMMAND "${CMAKE_COMMAND}" -E copy "${header}" "${bridge}/polycube-cxx/src/lib.rs.h"
  COMMAND "${CMAKE_COMMAND}" -E copy "${POLYCUBE_CARGO_TARGET_DIR}/cxxbridge/rust/cxx.h" "${bridge}/rust/cxx.h"
  DEPENDS ${sources} "${root}/Cargo.lock" "${root}/Cargo.toml" "${root}/rust/polycube/Cargo.toml"
          "${root}/rust/polycube-host/Cargo.toml" "${root}/rust/polycube-cxx/Cargo.toml"
          "${root}/rust/polycube-cxx/build.rs"
  COMMENT "Building the core with cargo (${POLYCUBE_CARGO_PROFILE})"
  USES_TERMINAL VERBATIM)
add_custom_target(polycube_core_build DEPENDS "${POLYCUBE_CORE_ARCHIVE}")

add_library(polycube_core STATIC IMPORTED GLOBAL)
set_target_properties(polycube_core PROPERTIES IMPORTED_LOCATION "${POLYCUBE_CORE_ARCHIVE}")
add_dependencies(polycube_core polycube_core_build)

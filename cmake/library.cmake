# The library that other programs link (server/library/awan.h): shared and static, with a CMake package and a pkg-config
# file. README.md says how it is installed.
add_library(awan_interface OBJECT server/library/awan.cpp)
target_precompile_headers(awan_interface REUSE_FROM awan_core_work)
target_link_libraries(awan_interface PRIVATE awan_common)
target_compile_options(awan_interface PRIVATE $<$<BOOL:${AWAN_BATCHES}>:-O1>)

set(AWAN_LIBRARY_OBJECTS $<TARGET_OBJECTS:awan_core_work> $<TARGET_OBJECTS:awan_core_light_work>
    $<TARGET_OBJECTS:awan_document> $<TARGET_OBJECTS:awan_interface>)
# What it needs of the system, by the names of pkg-config: one list for the linker and for both packages.
set(AWAN_LIBRARY_NEEDS OpenEXR libpng cairo libwebp libwebpmux zlib minizip libxxhash egl opengl)
pkg_check_modules(AWAN_LIBRARY_NEEDS REQUIRED IMPORTED_TARGET ${AWAN_LIBRARY_NEEDS})

foreach(kind shared static)
    string(TOUPPER ${kind} upper)
    add_library(awan_${kind} ${upper} ${AWAN_LIBRARY_OBJECTS})
    # Both are libawan.
    set_target_properties(awan_${kind} PROPERTIES OUTPUT_NAME awan LINKER_LANGUAGE CXX EXPORT_NAME ${kind})
    target_include_directories(awan_${kind} INTERFACE $<INSTALL_INTERFACE:include>)
    target_compile_features(awan_${kind} INTERFACE cxx_std_20)
    target_link_libraries(awan_${kind} PRIVATE PkgConfig::AWAN_LIBRARY_NEEDS Threads::Threads ${CMAKE_DL_LIBS})
endforeach()
# Before version 1 every minor version may break what was.
set_target_properties(awan_shared PROPERTIES VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
target_link_options(awan_shared PRIVATE -Wl,--no-undefined -Wl,--version-script=${CMAKE_SOURCE_DIR}/cmake/library.map)
set_target_properties(awan_shared PROPERTIES LINK_DEPENDS ${CMAKE_SOURCE_DIR}/cmake/library.map)
add_custom_target(awan_library DEPENDS awan_shared awan_static)

include(CMakePackageConfigHelpers)
set(packages ${CMAKE_BINARY_DIR}/generated/packages)
string(REPLACE ";" " " AWAN_LIBRARY_NEEDS_TEXT "${AWAN_LIBRARY_NEEDS}")
configure_package_config_file(cmake/awan-config.cmake.in ${packages}/awan-config.cmake INSTALL_DESTINATION lib/cmake/awan)
write_basic_package_version_file(${packages}/awan-config-version.cmake COMPATIBILITY SameMinorVersion)
configure_file(cmake/awan.pc.in ${packages}/awan.pc @ONLY)

install(TARGETS awan_shared awan_static EXPORT awan_library
    LIBRARY DESTINATION lib COMPONENT library ARCHIVE DESTINATION lib COMPONENT library)
install(EXPORT awan_library NAMESPACE awan:: FILE awan-targets.cmake DESTINATION lib/cmake/awan COMPONENT library)
install(FILES server/library/awan.h DESTINATION include/awan COMPONENT library)
install(FILES ${packages}/awan-config.cmake ${packages}/awan-config-version.cmake
    DESTINATION lib/cmake/awan COMPONENT library)
install(FILES ${packages}/awan.pc DESTINATION lib/pkgconfig COMPONENT library)

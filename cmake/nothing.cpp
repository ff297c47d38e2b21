// A target that holds nothing but precompiled headers needs a source (cmake/precompiled_headers.cmake).

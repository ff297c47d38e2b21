/// Whether tests are built with AddressSanitizer: SOLIDUS_ADDRESS_SANITIZER is defined then.
#pragma once

#if defined(__SANITIZE_ADDRESS__)
#define SOLIDUS_ADDRESS_SANITIZER
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define SOLIDUS_ADDRESS_SANITIZER
#endif
#endif

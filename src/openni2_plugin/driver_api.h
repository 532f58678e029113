#pragma once

// OpenNI2's interface for driver plug-ins, with the two macros that it expects from whoever
// includes it.
#include <OniCEnums.h>

#include <cstdint>
#include <new>

#ifndef XN_NEW
#define XN_NEW(type, arg) new type(arg)
#define XN_DELETE(pointer) delete (pointer)
#endif
#include <Driver/OniDriverAPI.h>

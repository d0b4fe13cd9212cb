// Stands in for Apple's <metal_stdlib>, as C++14: the types, functions and keywords of the Metal Shading Language
// Specification (sections 2, 4, 5 and 6) that emitted code uses, and nothing else of it. What a C++ compiler accepts with it
// is a checked part of the language. Address spaces are not told apart; attributes are judged elsewhere.
#pragma once
#include <cmath>
#include <cstdint>
#include <cstring>

// address spaces, which a C++ compiler need not tell apart, and kinds of entry points
#define constant const
#define device
#define thread
#define kernel
#define vertex
#define fragment
// the C library has one of this name, too
#define abs abs_of_metal

namespace metal {

typedef uint32_t uint;

template <typename To, typename T, int N, int... I>
struct swizzle {
    T data[N];
    operator To() const { return To(data[I]...); }
};

// components by several letters, which give a vector of so many
#define TO2(V, T, N, a, b, name) swizzle<V##2, T, N, a, b> name;
#define TO3(V, T, N, a, b, c, name) swizzle<V##3, T, N, a, b, c> name;
#define OF2(V, T) \
    TO2(V, T, 2, 0, 0, xx) TO2(V, T, 2, 0, 1, xy) TO2(V, T, 2, 1, 0, yx) TO2(V, T, 2, 1, 1, yy)
#define OF3(V, T) \
    TO2(V, T, 3, 0, 0, xx) TO2(V, T, 3, 0, 1, xy) TO2(V, T, 3, 0, 2, xz) TO2(V, T, 3, 1, 0, yx) \
    TO2(V, T, 3, 1, 1, yy) TO2(V, T, 3, 1, 2, yz) TO2(V, T, 3, 2, 0, zx) TO2(V, T, 3, 2, 1, zy) \
    TO2(V, T, 3, 2, 2, zz) TO3(V, T, 3, 0, 0, 0, xxx) TO3(V, T, 3, 0, 0, 1, xxy) TO3(V, T, 3, 0, 0, 2, xxz) \
    TO3(V, T, 3, 0, 1, 0, xyx) TO3(V, T, 3, 0, 1, 1, xyy) TO3(V, T, 3, 0, 1, 2, xyz) TO3(V, T, 3, 0, 2, 0, xzx) \
    TO3(V, T, 3, 0, 2, 1, xzy) TO3(V, T, 3, 0, 2, 2, xzz) TO3(V, T, 3, 1, 0, 0, yxx) TO3(V, T, 3, 1, 0, 1, yxy) \
    TO3(V, T, 3, 1, 0, 2, yxz) TO3(V, T, 3, 1, 1, 0, yyx) TO3(V, T, 3, 1, 1, 1, yyy) TO3(V, T, 3, 1, 1, 2, yyz) \
    TO3(V, T, 3, 1, 2, 0, yzx) TO3(V, T, 3, 1, 2, 1, yzy) TO3(V, T, 3, 1, 2, 2, yzz) TO3(V, T, 3, 2, 0, 0, zxx) \
    TO3(V, T, 3, 2, 0, 1, zxy) TO3(V, T, 3, 2, 0, 2, zxz) TO3(V, T, 3, 2, 1, 0, zyx) TO3(V, T, 3, 2, 1, 1, zyy) \
    TO3(V, T, 3, 2, 1, 2, zyz) TO3(V, T, 3, 2, 2, 0, zzx) TO3(V, T, 3, 2, 2, 1, zzy) TO3(V, T, 3, 2, 2, 2, zzz)
#define OF4(V, T) \
    TO2(V, T, 4, 0, 0, xx) TO2(V, T, 4, 0, 1, xy) TO2(V, T, 4, 0, 2, xz) TO2(V, T, 4, 0, 3, xw) \
    TO2(V, T, 4, 1, 0, yx) TO2(V, T, 4, 1, 1, yy) TO2(V, T, 4, 1, 2, yz) TO2(V, T, 4, 1, 3, yw) \
    TO2(V, T, 4, 2, 0, zx) TO2(V, T, 4, 2, 1, zy) TO2(V, T, 4, 2, 2, zz) TO2(V, T, 4, 2, 3, zw) \
    TO2(V, T, 4, 3, 0, wx) TO2(V, T, 4, 3, 1, wy) TO2(V, T, 4, 3, 2, wz) TO2(V, T, 4, 3, 3, ww) \
    TO3(V, T, 4, 0, 0, 0, xxx) TO3(V, T, 4, 0, 0, 1, xxy) TO3(V, T, 4, 0, 0, 2, xxz) TO3(V, T, 4, 0, 0, 3, xxw) \
    TO3(V, T, 4, 0, 1, 0, xyx) TO3(V, T, 4, 0, 1, 1, xyy) TO3(V, T, 4, 0, 1, 2, xyz) TO3(V, T, 4, 0, 1, 3, xyw) \
    TO3(V, T, 4, 0, 2, 0, xzx) TO3(V, T, 4, 0, 2, 1, xzy) TO3(V, T, 4, 0, 2, 2, xzz) TO3(V, T, 4, 0, 2, 3, xzw) \
    TO3(V, T, 4, 0, 3, 0, xwx) TO3(V, T, 4, 0, 3, 1, xwy) TO3(V, T, 4, 0, 3, 2, xwz) TO3(V, T, 4, 0, 3, 3, xww) \
    TO3(V, T, 4, 1, 0, 0, yxx) TO3(V, T, 4, 1, 0, 1, yxy) TO3(V, T, 4, 1, 0, 2, yxz) TO3(V, T, 4, 1, 0, 3, yxw) \
    TO3(V, T, 4, 1, 1, 0, yyx) TO3(V, T, 4, 1, 1, 1, yyy) TO3(V, T, 4, 1, 1, 2, yyz) TO3(V, T, 4, 1, 1, 3, yyw) \
    TO3(V, T, 4, 1, 2, 0, yzx) TO3(V, T, 4, 1, 2, 1, yzy) TO3(V, T, 4, 1, 2, 2, yzz) TO3(V, T, 4, 1, 2, 3, yzw) \
    TO3(V, T, 4, 1, 3, 0, ywx) TO3(V, T, 4, 1, 3, 1, ywy) TO3(V, T, 4, 1, 3, 2, ywz) TO3(V, T, 4, 1, 3, 3, yww) \
    TO3(V, T, 4, 2, 0, 0, zxx) TO3(V, T, 4, 2, 0, 1, zxy) TO3(V, T, 4, 2, 0, 2, zxz) TO3(V, T, 4, 2, 0, 3, zxw) \
    TO3(V, T, 4, 2, 1, 0, zyx) TO3(V, T, 4, 2, 1, 1, zyy) TO3(V, T, 4, 2, 1, 2, zyz) TO3(V, T, 4, 2, 1, 3, zyw) \
    TO3(V, T, 4, 2, 2, 0, zzx) TO3(V, T, 4, 2, 2, 1, zzy) TO3(V, T, 4, 2, 2, 2, zzz) TO3(V, T, 4, 2, 2, 3, zzw) \
    TO3(V, T, 4, 2, 3, 0, zwx) TO3(V, T, 4, 2, 3, 1, zwy) TO3(V, T, 4, 2, 3, 2, zwz) TO3(V, T, 4, 2, 3, 3, zww) \
    TO3(V, T, 4, 3, 0, 0, wxx) TO3(V, T, 4, 3, 0, 1, wxy) TO3(V, T, 4, 3, 0, 2, wxz) TO3(V, T, 4, 3, 0, 3, wxw) \
    TO3(V, T, 4, 3, 1, 0, wyx) TO3(V, T, 4, 3, 1, 1, wyy) TO3(V, T, 4, 3, 1, 2, wyz) TO3(V, T, 4, 3, 1, 3, wyw) \
    TO3(V, T, 4, 3, 2, 0, wzx) TO3(V, T, 4, 3, 2, 1, wzy) TO3(V, T, 4, 3, 2, 2, wzz) TO3(V, T, 4, 3, 2, 3, wzw) \
    TO3(V, T, 4, 3, 3, 0, wwx) TO3(V, T, 4, 3, 3, 1, wwy) TO3(V, T, 4, 3, 3, 2, wwz) TO3(V, T, 4, 3, 3, 3, www)

struct float2; struct float3; struct float4;
struct int2; struct int3; struct int4;
struct uint2; struct uint3; struct uint4;
struct bool2; struct bool3; struct bool4;

struct float2 {
    union {
        float data[2];
        struct { float x, y; };
        OF2(float, float)
    };
    float2() : data{} {}
    explicit float2(int2 v);
    explicit float2(uint2 v);
    explicit float2(bool2 v);
    explicit float2(float s) : data{s, s} {}
    float2(float a, float b) : data{a, b} {}
    float& operator[](int k) { return data[k]; }
    float operator[](int k) const { return data[k]; }
};

struct float3 {
    union {
        float data[3];
        struct { float x, y, z; };
        OF3(float, float)
    };
    float3() : data{} {}
    explicit float3(int3 v);
    explicit float3(uint3 v);
    explicit float3(bool3 v);
    explicit float3(float s) : data{s, s, s} {}
    float3(float a, float b, float c) : data{a, b, c} {}
    float3(float2 a, float b);
    float3(float a, float2 b);
    float& operator[](int k) { return data[k]; }
    float operator[](int k) const { return data[k]; }
};

struct float4 {
    union {
        float data[4];
        struct { float x, y, z, w; };
        OF4(float, float)
    };
    float4() : data{} {}
    explicit float4(int4 v);
    explicit float4(uint4 v);
    explicit float4(bool4 v);
    explicit float4(float s) : data{s, s, s, s} {}
    float4(float a, float b, float c, float d) : data{a, b, c, d} {}
    float4(float3 a, float b);
    float4(float a, float3 b);
    float4(float2 a, float2 b);
    float4(float2 a, float b, float c);
    float& operator[](int k) { return data[k]; }
    float operator[](int k) const { return data[k]; }
};

inline float3::float3(float2 a, float b) : data{a.x, a.y, b} {}
inline float3::float3(float a, float2 b) : data{a, b.x, b.y} {}
inline float4::float4(float3 a, float b) : data{a.x, a.y, a.z, b} {}
inline float4::float4(float a, float3 b) : data{a, b.x, b.y, b.z} {}
inline float4::float4(float2 a, float2 b) : data{a.x, a.y, b.x, b.y} {}
inline float4::float4(float2 a, float b, float c) : data{a.x, a.y, b, c} {}

struct int2 {
    union {
        int data[2];
        struct { int x, y; };
        OF2(int, int)
    };
    int2() : data{} {}
    explicit int2(float2 v);
    explicit int2(uint2 v);
    explicit int2(bool2 v);
    explicit int2(int s) : data{s, s} {}
    int2(int a, int b) : data{a, b} {}
    int& operator[](int k) { return data[k]; }
    int operator[](int k) const { return data[k]; }
};

struct int3 {
    union {
        int data[3];
        struct { int x, y, z; };
        OF3(int, int)
    };
    int3() : data{} {}
    explicit int3(float3 v);
    explicit int3(uint3 v);
    explicit int3(bool3 v);
    explicit int3(int s) : data{s, s, s} {}
    int3(int a, int b, int c) : data{a, b, c} {}
    int3(int2 a, int b);
    int3(int a, int2 b);
    int& operator[](int k) { return data[k]; }
    int operator[](int k) const { return data[k]; }
};

struct int4 {
    union {
        int data[4];
        struct { int x, y, z, w; };
        OF4(int, int)
    };
    int4() : data{} {}
    explicit int4(float4 v);
    explicit int4(uint4 v);
    explicit int4(bool4 v);
    explicit int4(int s) : data{s, s, s, s} {}
    int4(int a, int b, int c, int d) : data{a, b, c, d} {}
    int4(int3 a, int b);
    int4(int a, int3 b);
    int4(int2 a, int2 b);
    int4(int2 a, int b, int c);
    int& operator[](int k) { return data[k]; }
    int operator[](int k) const { return data[k]; }
};

inline int3::int3(int2 a, int b) : data{a.x, a.y, b} {}
inline int3::int3(int a, int2 b) : data{a, b.x, b.y} {}
inline int4::int4(int3 a, int b) : data{a.x, a.y, a.z, b} {}
inline int4::int4(int a, int3 b) : data{a, b.x, b.y, b.z} {}
inline int4::int4(int2 a, int2 b) : data{a.x, a.y, b.x, b.y} {}
inline int4::int4(int2 a, int b, int c) : data{a.x, a.y, b, c} {}

struct uint2 {
    union {
        uint data[2];
        struct { uint x, y; };
        OF2(uint, uint)
    };
    uint2() : data{} {}
    explicit uint2(float2 v);
    explicit uint2(int2 v);
    explicit uint2(bool2 v);
    explicit uint2(uint s) : data{s, s} {}
    uint2(uint a, uint b) : data{a, b} {}
    uint& operator[](int k) { return data[k]; }
    uint operator[](int k) const { return data[k]; }
};

struct uint3 {
    union {
        uint data[3];
        struct { uint x, y, z; };
        OF3(uint, uint)
    };
    uint3() : data{} {}
    explicit uint3(float3 v);
    explicit uint3(int3 v);
    explicit uint3(bool3 v);
    explicit uint3(uint s) : data{s, s, s} {}
    uint3(uint a, uint b, uint c) : data{a, b, c} {}
    uint3(uint2 a, uint b);
    uint3(uint a, uint2 b);
    uint& operator[](int k) { return data[k]; }
    uint operator[](int k) const { return data[k]; }
};

struct uint4 {
    union {
        uint data[4];
        struct { uint x, y, z, w; };
        OF4(uint, uint)
    };
    uint4() : data{} {}
    explicit uint4(float4 v);
    explicit uint4(int4 v);
    explicit uint4(bool4 v);
    explicit uint4(uint s) : data{s, s, s, s} {}
    uint4(uint a, uint b, uint c, uint d) : data{a, b, c, d} {}
    uint4(uint3 a, uint b);
    uint4(uint a, uint3 b);
    uint4(uint2 a, uint2 b);
    uint4(uint2 a, uint b, uint c);
    uint& operator[](int k) { return data[k]; }
    uint operator[](int k) const { return data[k]; }
};

inline uint3::uint3(uint2 a, uint b) : data{a.x, a.y, b} {}
inline uint3::uint3(uint a, uint2 b) : data{a, b.x, b.y} {}
inline uint4::uint4(uint3 a, uint b) : data{a.x, a.y, a.z, b} {}
inline uint4::uint4(uint a, uint3 b) : data{a, b.x, b.y, b.z} {}
inline uint4::uint4(uint2 a, uint2 b) : data{a.x, a.y, b.x, b.y} {}
inline uint4::uint4(uint2 a, uint b, uint c) : data{a.x, a.y, b, c} {}

struct bool2 {
    union {
        bool data[2];
        struct { bool x, y; };
        OF2(bool, bool)
    };
    bool2() : data{} {}
    explicit bool2(float2 v);
    explicit bool2(int2 v);
    explicit bool2(uint2 v);
    explicit bool2(bool s) : data{s, s} {}
    bool2(bool a, bool b) : data{a, b} {}
    bool& operator[](int k) { return data[k]; }
    bool operator[](int k) const { return data[k]; }
};

struct bool3 {
    union {
        bool data[3];
        struct { bool x, y, z; };
        OF3(bool, bool)
    };
    bool3() : data{} {}
    explicit bool3(float3 v);
    explicit bool3(int3 v);
    explicit bool3(uint3 v);
    explicit bool3(bool s) : data{s, s, s} {}
    bool3(bool a, bool b, bool c) : data{a, b, c} {}
    bool3(bool2 a, bool b);
    bool3(bool a, bool2 b);
    bool& operator[](int k) { return data[k]; }
    bool operator[](int k) const { return data[k]; }
};

struct bool4 {
    union {
        bool data[4];
        struct { bool x, y, z, w; };
        OF4(bool, bool)
    };
    bool4() : data{} {}
    explicit bool4(float4 v);
    explicit bool4(int4 v);
    explicit bool4(uint4 v);
    explicit bool4(bool s) : data{s, s, s, s} {}
    bool4(bool a, bool b, bool c, bool d) : data{a, b, c, d} {}
    bool4(bool3 a, bool b);
    bool4(bool a, bool3 b);
    bool4(bool2 a, bool2 b);
    bool4(bool2 a, bool b, bool c);
    bool& operator[](int k) { return data[k]; }
    bool operator[](int k) const { return data[k]; }
};

inline bool3::bool3(bool2 a, bool b) : data{a.x, a.y, b} {}
inline bool3::bool3(bool a, bool2 b) : data{a, b.x, b.y} {}
inline bool4::bool4(bool3 a, bool b) : data{a.x, a.y, a.z, b} {}
inline bool4::bool4(bool a, bool3 b) : data{a, b.x, b.y, b.z} {}
inline bool4::bool4(bool2 a, bool2 b) : data{a.x, a.y, b.x, b.y} {}
inline bool4::bool4(bool2 a, bool b, bool c) : data{a.x, a.y, b, c} {}

inline float2::float2(int2 v) : data{float(v.x), float(v.y)} {}
inline float2::float2(uint2 v) : data{float(v.x), float(v.y)} {}
inline float2::float2(bool2 v) : data{float(v.x), float(v.y)} {}
inline float3::float3(int3 v) : data{float(v.x), float(v.y), float(v.z)} {}
inline float3::float3(uint3 v) : data{float(v.x), float(v.y), float(v.z)} {}
inline float3::float3(bool3 v) : data{float(v.x), float(v.y), float(v.z)} {}
inline float4::float4(int4 v) : data{float(v.x), float(v.y), float(v.z), float(v.w)} {}
inline float4::float4(uint4 v) : data{float(v.x), float(v.y), float(v.z), float(v.w)} {}
inline float4::float4(bool4 v) : data{float(v.x), float(v.y), float(v.z), float(v.w)} {}
inline int2::int2(float2 v) : data{int(v.x), int(v.y)} {}
inline int2::int2(uint2 v) : data{int(v.x), int(v.y)} {}
inline int2::int2(bool2 v) : data{int(v.x), int(v.y)} {}
inline int3::int3(float3 v) : data{int(v.x), int(v.y), int(v.z)} {}
inline int3::int3(uint3 v) : data{int(v.x), int(v.y), int(v.z)} {}
inline int3::int3(bool3 v) : data{int(v.x), int(v.y), int(v.z)} {}
inline int4::int4(float4 v) : data{int(v.x), int(v.y), int(v.z), int(v.w)} {}
inline int4::int4(uint4 v) : data{int(v.x), int(v.y), int(v.z), int(v.w)} {}
inline int4::int4(bool4 v) : data{int(v.x), int(v.y), int(v.z), int(v.w)} {}
inline uint2::uint2(float2 v) : data{uint(v.x), uint(v.y)} {}
inline uint2::uint2(int2 v) : data{uint(v.x), uint(v.y)} {}
inline uint2::uint2(bool2 v) : data{uint(v.x), uint(v.y)} {}
inline uint3::uint3(float3 v) : data{uint(v.x), uint(v.y), uint(v.z)} {}
inline uint3::uint3(int3 v) : data{uint(v.x), uint(v.y), uint(v.z)} {}
inline uint3::uint3(bool3 v) : data{uint(v.x), uint(v.y), uint(v.z)} {}
inline uint4::uint4(float4 v) : data{uint(v.x), uint(v.y), uint(v.z), uint(v.w)} {}
inline uint4::uint4(int4 v) : data{uint(v.x), uint(v.y), uint(v.z), uint(v.w)} {}
inline uint4::uint4(bool4 v) : data{uint(v.x), uint(v.y), uint(v.z), uint(v.w)} {}
inline bool2::bool2(float2 v) : data{bool(v.x), bool(v.y)} {}
inline bool2::bool2(int2 v) : data{bool(v.x), bool(v.y)} {}
inline bool2::bool2(uint2 v) : data{bool(v.x), bool(v.y)} {}
inline bool3::bool3(float3 v) : data{bool(v.x), bool(v.y), bool(v.z)} {}
inline bool3::bool3(int3 v) : data{bool(v.x), bool(v.y), bool(v.z)} {}
inline bool3::bool3(uint3 v) : data{bool(v.x), bool(v.y), bool(v.z)} {}
inline bool4::bool4(float4 v) : data{bool(v.x), bool(v.y), bool(v.z), bool(v.w)} {}
inline bool4::bool4(int4 v) : data{bool(v.x), bool(v.y), bool(v.z), bool(v.w)} {}
inline bool4::bool4(uint4 v) : data{bool(v.x), bool(v.y), bool(v.z), bool(v.w)} {}

#define EACH(V, N, value) V out; for (int k = 0; k < N; k++) out[k] = value; return out;
#define OPERATOR(V, T, N, op) \
    inline V operator op(V a, V b) { EACH(V, N, a[k] op b[k]) } \
    inline V operator op(V a, T b) { EACH(V, N, a[k] op b) } \
    inline V operator op(T a, V b) { EACH(V, N, a op b[k]) } \
    inline V& operator op##=(V& a, V b) { return a = a op b; } \
    inline V& operator op##=(V& a, T b) { return a = a op b; }
#define COMPARE(V, B, N, op) inline B operator op(V a, V b) { EACH(B, N, a[k] op b[k]) }
#define ONE(V, N, name) inline V name(V a) { EACH(V, N, name(a[k])) }
#define TWO(V, N, name) inline V name(V a, V b) { EACH(V, N, name(a[k], b[k])) }

template <typename To, typename From>
To as_type(From from) {
    static_assert(sizeof(To) == sizeof(From), "as_type keeps the size");
    To to;
    std::memcpy(&to, &from, sizeof to);
    return to;
}

template <typename To, typename V, typename T, int N, int... I>
To as_type(const swizzle<V, T, N, I...>& from) {
    return as_type<To>(V(from));
}

#define FLOAT1(name, of) inline float name(float x) { return of(x); }
FLOAT1(cos, ::cosf) FLOAT1(cosh, ::coshf) FLOAT1(sin, ::sinf) FLOAT1(sinh, ::sinhf) FLOAT1(tan, ::tanf)
FLOAT1(tanh, ::tanhf) FLOAT1(acos, ::acosf) FLOAT1(asin, ::asinf) FLOAT1(atan, ::atanf) FLOAT1(asinh, ::asinhf)
FLOAT1(acosh, ::acoshf) FLOAT1(atanh, ::atanhf) FLOAT1(ceil, ::ceilf) FLOAT1(floor, ::floorf) FLOAT1(trunc, ::truncf)
FLOAT1(rint, ::rintf) FLOAT1(exp, ::expf) FLOAT1(exp2, ::exp2f) FLOAT1(log, ::logf) FLOAT1(log2, ::log2f)
FLOAT1(sqrt, ::sqrtf) FLOAT1(abs, ::fabsf)
inline float atan2(float y, float x) { return ::atan2f(y, x); }
inline float pow(float x, float y) { return ::powf(x, y); }
inline float fma(float a, float b, float c) { return ::fmaf(a, b, c); }
inline float rsqrt(float x) { return 1.0f / ::sqrtf(x); }
inline float fract(float x) { return x - ::floorf(x); }
inline float sign(float x) { return float(x > 0.0f) - float(x < 0.0f); }
inline float min(float a, float b) { return ::fminf(a, b); }
inline float max(float a, float b) { return ::fmaxf(a, b); }
inline float clamp(float x, float lo, float hi) { return min(max(x, lo), hi); }
inline float saturate(float x) { return clamp(x, 0.0f, 1.0f); }
inline float mix(float a, float b, float t) { return a + (b - a) * t; }
inline float step(float edge, float x) { return x < edge ? 0.0f : 1.0f; }
inline float smoothstep(float lo, float hi, float x) {
    float t = saturate((x - lo) / (hi - lo));
    return t * t * (3.0f - 2.0f * t);
}
inline int abs(int x) { return x < 0 ? -x : x; }
inline int min(int a, int b) { return a < b ? a : b; }
inline int max(int a, int b) { return a > b ? a : b; }
inline int clamp(int x, int lo, int hi) { return min(max(x, lo), hi); }
inline uint min(uint a, uint b) { return a < b ? a : b; }
inline uint max(uint a, uint b) { return a > b ? a : b; }
inline uint clamp(uint x, uint lo, uint hi) { return min(max(x, lo), hi); }
inline uint clz(uint x) { return x == 0u ? 32u : uint(__builtin_clz(x)); }
inline bool isnan(float x) { return x != x; }
inline bool isinf(float x) { return x == x && x - x != x - x; }

#define FLOATS(N) \
    OPERATOR(float##N, float, N, +) OPERATOR(float##N, float, N, -) \
    OPERATOR(float##N, float, N, *) OPERATOR(float##N, float, N, /) \
    COMPARE(float##N, bool##N, N, <) COMPARE(float##N, bool##N, N, <=) COMPARE(float##N, bool##N, N, >) \
    COMPARE(float##N, bool##N, N, >=) COMPARE(float##N, bool##N, N, ==) COMPARE(float##N, bool##N, N, !=) \
    inline float##N operator-(float##N a) { EACH(float##N, N, -a[k]) } \
    ONE(float##N, N, abs) ONE(float##N, N, floor) ONE(float##N, N, ceil) ONE(float##N, N, fract) \
    ONE(float##N, N, sign) \
    ONE(float##N, N, sqrt) ONE(float##N, N, sin) ONE(float##N, N, cos) ONE(float##N, N, exp) ONE(float##N, N, log) \
    ONE(float##N, N, trunc) ONE(float##N, N, rint) ONE(float##N, N, rsqrt) ONE(float##N, N, exp2) \
    ONE(float##N, N, log2) TWO(float##N, N, min) TWO(float##N, N, max) TWO(float##N, N, pow) \
    inline float dot(float##N a, float##N b) { \
        float sum = 0.0f; \
        for (int k = 0; k < N; k++) sum += a[k] * b[k]; \
        return sum; \
    } \
    inline float length(float##N a) { return sqrt(dot(a, a)); } \
    inline float distance(float##N a, float##N b) { return length(a - b); } \
    inline float##N normalize(float##N a) { return a / length(a); } \
    inline float##N clamp(float##N x, float##N lo, float##N hi) { return min(max(x, lo), hi); } \
    inline float##N clamp(float##N x, float lo, float hi) { return clamp(x, float##N(lo), float##N(hi)); } \
    inline float##N min(float##N a, float b) { return min(a, float##N(b)); } \
    inline float##N max(float##N a, float b) { return max(a, float##N(b)); } \
    inline float##N smoothstep(float##N lo, float##N hi, float##N x) { \
        EACH(float##N, N, smoothstep(lo[k], hi[k], x[k])) \
    } \
    inline float##N mix(float##N a, float##N b, float##N t) { return a + (b - a) * t; } \
    inline float##N mix(float##N a, float##N b, float t) { return a + (b - a) * t; } \
    inline float##N fma(float##N a, float##N b, float##N c) { EACH(float##N, N, fma(a[k], b[k], c[k])) } \
    inline float##N select(float##N a, float##N b, bool##N c) { EACH(float##N, N, c[k] ? b[k] : a[k]) } \
    inline bool all(bool##N a) { for (int k = 0; k < N; k++) if (!a[k]) return false; return true; } \
    inline bool any(bool##N a) { for (int k = 0; k < N; k++) if (a[k]) return true; return false; }
FLOATS(2) FLOATS(3) FLOATS(4)
#define WHOLES(V, T, N) \
    COMPARE(V, bool##N, N, <) COMPARE(V, bool##N, N, <=) COMPARE(V, bool##N, N, >) \
    COMPARE(V, bool##N, N, >=) COMPARE(V, bool##N, N, ==) COMPARE(V, bool##N, N, !=) \
    TWO(V, N, min) TWO(V, N, max) \
    inline V operator-(V a) { EACH(V, N, -a[k]) } \
    inline V operator~(V a) { EACH(V, N, ~a[k]) } \
    inline V select(V a, V b, bool##N c) { EACH(V, N, c[k] ? b[k] : a[k]) } \
    OPERATOR(V, T, N, +) OPERATOR(V, T, N, -) OPERATOR(V, T, N, *) OPERATOR(V, T, N, &) \
    OPERATOR(V, T, N, |) OPERATOR(V, T, N, ^) \
    OPERATOR(V, T, N, <<) OPERATOR(V, T, N, >>)
WHOLES(int2, int, 2) WHOLES(int3, int, 3) WHOLES(int4, int, 4)
WHOLES(uint2, uint, 2) WHOLES(uint3, uint, 3) WHOLES(uint4, uint, 4)
#define TRUTHS(N) COMPARE(bool##N, bool##N, N, ==) COMPARE(bool##N, bool##N, N, !=)
TRUTHS(2) TRUTHS(3) TRUTHS(4)
inline float3 cross(float3 a, float3 b) {
    return float3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
inline float select(float a, float b, bool c) { return c ? b : a; }
inline int select(int a, int b, bool c) { return c ? b : a; }
inline uint select(uint a, uint b, bool c) { return c ? b : a; }
inline bool select(bool a, bool b, bool c) { return c ? b : a; }

#undef EACH
#undef OPERATOR
#undef COMPARE
#undef ONE
#undef TWO
#undef FLOAT1
#undef FLOATS
#undef WHOLES
#undef TRUTHS
#undef TO2
#undef TO3
#undef OF2
#undef OF3
#undef OF4

// three numbers without a fourth as padding, which turn into a vector where one is wanted
struct packed_float3 : float3 {
    packed_float3() = default;
    packed_float3(float3 v) : float3(v) {}
    packed_float3(float a, float b, float c) : float3(a, b, c) {}
};

inline uint pack_float_to_unorm4x8(float4 v) {
    uint out = 0u;
    for (int k = 0; k < 4; k++) out |= uint(rint(clamp(v[k], 0.0f, 1.0f) * 255.0f)) << (8 * k);
    return out;
}

}  // namespace metal

// types of the language itself, which are in no namespace
using metal::as_type;
using metal::float2; using metal::float3; using metal::float4;
using metal::int2; using metal::int3; using metal::int4;
using metal::uint2; using metal::uint3; using metal::uint4;
using metal::bool2; using metal::bool3; using metal::bool4;

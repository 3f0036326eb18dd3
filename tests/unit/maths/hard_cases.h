// hard_cases.h: arguments whose results are hard to round. The comments give the distance, in half ulps, between the
// exact result and the nearest double or midpoint (halfway between two doubles). The first list is from the literature:
// Lefèvre and Muller's tables of worst cases and later work. The second list was found with find_hard.c.
#pragma once

typedef struct HardCase {
    const char *name;
    double x, y;
} HardCase;

static const HardCase hard_cases[] = {
    {"acos", 0x1.53ea6c7255e88p-4, 0},    // 2^-57.7 from a midpoint
    {"acos", 0x1.fd737be914578p-11, 0},   // 2^-62.2 from a double
    {"asin", 0x1.c373ff4aad79bp-14, 0},   // 2^-57.6 from a midpoint
    {"asin", 0x1.e9950730c4696p-2, 0},    // 2^-64.9 from a double
    {"cos", 0x1.06b505550e6b2p-9, 0},     // 2^-58.3 from a double
    {"cos", 0x1.20000000000f3p-20, 0},    // 2^-72.7 from a double
    {"cos", 0x1.34ec2f9fc9cp+1, 0},       // 2^-58.8 from a midpoint
    {"cos", 0x1.8000000000009p-23, 0},    // 2^-88.2 from a double
    {"cos", 0x1.8000000000024p-22, 0},    // 2^-82.2 from a double
    {"cos", 0x1.800000000009p-21, 0},     // 2^-76.2 from a double
    {"exp", -0x1.02393d5976769p+1, 0},    // 2^-53.0 from a midpoint
    {"exp", -0x1.22e24fa3d5cf9p-1, 0},    // 2^-52.1 from a midpoint
    {"exp", -0x1.290ea09e36479p-3, 0},    // 2^-56.9 from a double
    {"exp", -0x1.dc2b5df1f7d3dp-1, 0},    // 2^-52.1 from a double
    {"exp", -0x1.ed318efb627eap-27, 0},   // 2^-59.1 from a double
    {"exp", 0x1.005ae04256babp-1, 0},     // 2^-52.9 from a midpoint
    {"exp", 0x1.08f51434652c3p+4, 0},     // 2^-53.2 from a double
    {"exp", 0x1.1d5c2daebe367p+4, 0},     // 2^-54.1 from a double
    {"exp", 0x1.273c188aa7b14p+2, 0},     // 2^-53.7 from a midpoint
    {"exp", 0x1.6a4d1af9cc989p-8, 0},     // 2^-54.4 from a midpoint
    {"exp", 0x1.83d4bcdebb3f4p+2, 0},     // 2^-57.9 from a double
    {"exp", 0x1.9e9cbbfd6080bp-31, 0},    // 2^-57.6 from a midpoint
    {"exp", 0x1.accfbe46b4efp-1, 0},      // 2^-54.6 from a midpoint
    {"exp", 0x1.c44ce0d716a1ap+4, 0},     // 2^-54.2 from a double
    {"log", 0x1.62a88613629b6p+678, 0},   // 2^-64.2 from a double
    {"log10", 0x1.e12d66744ff81p+429, 0}, // 2^-68.8 from a midpoint
    {"log2", 0x1.1ba39ff28e3eap+0, 0},    // 2^-49.8 from a double
    {"log2", 0x1.61555f75885b4p+0, 0},    // 2^-44.4 from a double
    {"log2", 0x1.b4ebe40c95a01p+0, 0},    // 2^-53.5 from a midpoint
    {"sin", 0x1.598bae9e632f6p-7, 0},     // 2^-59.1 from a midpoint
    {"sin", 0x1.9283586503fep-5, 0},      // 2^-55.2 from a double
    {"sin", 0x1.a202b3fb84788p-4, 0},     // 2^-52.6 from a double
    {"sin", 0x1.d037cb27ee6dfp-3, 0},     // 2^-52.0 from a midpoint
    {"sin", 0x1.d7bdcd778049fp-5, 0},     // 2^-55.3 from a double
    {"sin", 0x1.e0000000001c2p-20, 0},    // 2^-72.1 from a double
    {"sin", 0x1.fe767739d0f6dp-2, 0},     // 2^-65.1 from a double
    {"tan", 0x1.46ac372243536p-1, 0},     // 2^-54.4 from a double
    {"tan", 0x1.50486b2f87014p-5, 0},     // 2^-57.8 from a midpoint
    {"tan", 0x1.52c39ef070cadp-4, 0},     // 2^-53.1 from a double
    {"tan", 0x1.67fffffffa114p-18, 0},    // 2^-57.4 from a double
    {"tan", 0x1.a33f32ac5ceb5p-3, 0},     // 2^-55.6 from a double
    {"tan", 0x1.d696bfa988db9p-2, 0},     // 2^-51.7 from a midpoint
    {"tan", 0x1.dffffffffff1fp-22, 0},    // 2^-78.5 from a midpoint
    // found by find_hard.c
    {"sin", 0x1.ffe2a99eca841p-8, 0},                      // 2^-40.1
    {"sin", -0x1.144d42abfc5e2p-2, 0},                     // 2^-35.3
    {"sin", -0x1.01b1190fb52f6p-8, 0},                     // 2^-35.0
    {"sin", 0x1.84af2d21fc73dp-6, 0},                      // 2^-34.7
    {"sin", -0x1.40069c78254bbp-2, 0},                     // 2^-33.2
    {"sin", -0x1.01c27d0beddbbp+1, 0},                     // 2^-32.2
    {"sin", -0x1.9b12e4caa34ffp-8, 0},                     // 2^-32.1
    {"sin", -0x1.c08fd376e4dc4p-8, 0},                     // 2^-31.7
    {"sin", -0x1.7017d3c8f378ap-4, 0},                     // 2^-30.9
    {"sin", -0x1.263da76d7ae93p-4, 0},                     // 2^-30.7
    {"sin", -0x1.b2d0335943e71p-4, 0},                     // 2^-30.7
    {"sin", -0x1.70cc2c3e77609p+0, 0},                     // 2^-30.6
    {"sin", -0x1.497dd1ab905b4p-3, 0},                     // 2^-30.5
    {"sin", 0x1.8ea66909462ffp-4, 0},                      // 2^-30.1
    {"cos", -0x1.5e57589d698e9p-7, 0},                     // 2^-34.6
    {"cos", 0x1.9a9003b677d62p-1, 0},                      // 2^-32.9
    {"cos", 0x1.c45941619a9a6p-5, 0},                      // 2^-32.8
    {"cos", 0x1.870d7221987b9p-7, 0},                      // 2^-32.5
    {"cos", -0x1.8b7bc8deb6ce5p+1, 0},                     // 2^-32.3
    {"cos", 0x1.f63e667d63de5p-1, 0},                      // 2^-31.7
    {"cos", -0x1.4f7d9ca336982p-4, 0},                     // 2^-31.5
    {"cos", -0x1.fbcc0c52854bcp-7, 0},                     // 2^-31.4
    {"cos", -0x1.4c40f2c4b1479p-6, 0},                     // 2^-31.3
    {"cos", 0x1.5f0fbceecbe0ap-3, 0},                      // 2^-31.2
    {"cos", -0x1.a4a8dabed7ed4p-1, 0},                     // 2^-31.1
    {"cos", -0x1.a63f280cab10ap+1, 0},                     // 2^-31.0
    {"cos", -0x1.9746853f95578p+0, 0},                     // 2^-30.8
    {"cos", 0x1.c814b0efdc087p+0, 0},                      // 2^-30.5
    {"tan", 0x1.7bbc221b9b5f1p-7, 0},                      // 2^-35.0
    {"tan", 0x1.354a469d5a6d8p-7, 0},                      // 2^-31.0
    {"tan", -0x1.81378af93cf01p-3, 0},                     // 2^-30.8
    {"tan", -0x1.0964887219896p-7, 0},                     // 2^-29.7
    {"asin", -0x1.5da7a84c43794p-2, 0},                    // 2^-30.5
    {"asin", -0x1.a3170ff2c90d9p-7, 0},                    // 2^-29.9
    {"asin", 0x1.ce31d8295a0f8p-8, 0},                     // 2^-29.8
    {"asin", -0x1.3b5a127523ee3p-3, 0},                    // 2^-29.7
    {"asin", -0x1.af2b1cc86d3p-5, 0},                      // 2^-29.4
    {"asin", 0x1.8e2649296a396p-4, 0},                     // 2^-29.3
    {"asin", 0x1.3f074896304bep-8, 0},                     // 2^-29.2
    {"acos", -0x1.c17f44f00183ep-8, 0},                    // 2^-29.9
    {"acos", -0x1.43ddfa61febe5p-4, 0},                    // 2^-29.6
    {"exp", -0x1.481ccc0b26e2ap-11, 0},                    // 2^-33.8
    {"exp", 0x1.effed96d20a34p-8, 0},                      // 2^-33.3
    {"exp", 0x1.972c2bf4406a9p-2, 0},                      // 2^-32.1
    {"exp", -0x1.3eb4aaff010c8p-5, 0},                     // 2^-31.7
    {"exp", 0x1.fd54460836f0bp-8, 0},                      // 2^-30.7
    {"exp", -0x1.58d64b83db65ep-3, 0},                     // 2^-30.1
    {"exp", 0x1.22c65c6ef314fp-2, 0},                      // 2^-29.6
    {"exp", -0x1.42eac9c05c9b6p-5, 0},                     // 2^-29.6
    {"exp", -0x1.27be8747b0d8dp-6, 0},                     // 2^-29.4
    {"exp", 0x1.92fa6bc77e925p-7, 0},                      // 2^-29.3
    {"exp", -0x1.6a763eddece2ap-2, 0},                     // 2^-29.2
    {"exp", 0x1.a74950cd50ea2p+1, 0},                      // 2^-29.1
    {"log", 0x1.dcfc239e67951p+0, 0},                      // 2^-35.3
    {"log", 0x1.0e84f238f6d6dp+351, 0},                    // 2^-34.3
    {"log", 0x1.a7dadc934f399p-1, 0},                      // 2^-31.7
    {"log", 0x1.526b5b60ea6f6p-1, 0},                      // 2^-31.1
    {"log", 0x1.72be03b8fdb53p-1, 0},                      // 2^-31.0
    {"log", 0x1.3def41612a12bp-61, 0},                     // 2^-30.9
    {"log", 0x1.3aa5054591652p+806, 0},                    // 2^-30.9
    {"log", 0x1.68745e38187d3p+811, 0},                    // 2^-30.0
    {"log", 0x1.fd6196f4482fdp+257, 0},                    // 2^-30.0
    {"log", 0x1.32fcff684de6dp+810, 0},                    // 2^-30.0
    {"log", 0x1.3921211a1a01ep-1, 0},                      // 2^-29.9
    {"log", 0x1.c8e306543efc7p-1, 0},                      // 2^-29.9
    {"log", 0x1.5a2fe19428ee4p+0, 0},                      // 2^-29.9
    {"log", 0x1.312000e28b00ap-1, 0},                      // 2^-29.8
    {"log2", 0x1.4efc5dc98f7e2p-2, 0},                     // 2^-34.5
    {"log2", 0x1.88fd32baf5a45p-2, 0},                     // 2^-33.3
    {"log2", 0x1.4a3ea573b72d4p-1, 0},                     // 2^-31.7
    {"log2", 0x1.6d37297778ff4p-443, 0},                   // 2^-31.2
    {"log2", 0x1.d265849fb963bp-569, 0},                   // 2^-30.7
    {"log2", 0x1.c30003e0305b4p+110, 0},                   // 2^-30.5
    {"log2", 0x1.38df985e22155p-2, 0},                     // 2^-30.1
    {"log2", 0x1.dd4167f7f0606p+253, 0},                   // 2^-29.9
    {"log2", 0x1.24c7141a5ef41p-31, 0},                    // 2^-29.8
    {"log2", 0x1.aa8e0b6a39ep+589, 0},                     // 2^-29.8
    {"log2", 0x1.e29690c6e003ep+966, 0},                   // 2^-29.7
    {"log2", 0x1.e5eb8dadde6dbp+0, 0},                     // 2^-29.5
    {"log2", 0x1.857ab01c462fdp+340, 0},                   // 2^-29.5
    {"log2", 0x1.7f0734d6a4ceep-1, 0},                     // 2^-29.4
    {"log10", 0x1.161453ebd7799p+246, 0},                  // 2^-32.4
    {"log10", 0x1.88611f407f7f5p-2, 0},                    // 2^-32.1
    {"log10", 0x1.513395c1fd41fp-460, 0},                  // 2^-31.1
    {"log10", 0x1.119b03de76408p+292, 0},                  // 2^-30.8
    {"log10", 0x1.57478208a1db3p-1, 0},                    // 2^-30.7
    {"log10", 0x1.dbbb941195875p-763, 0},                  // 2^-30.2
    {"log10", 0x1.fa6050c793372p+93, 0},                   // 2^-30.1
    {"log10", 0x1.1bc18d429f537p+0, 0},                    // 2^-29.7
    {"log10", 0x1.b15ad423a5cbep-1, 0},                    // 2^-29.6
    {"log10", 0x1.e1ca3967a4265p-1, 0},                    // 2^-29.6
    {"log10", 0x1.e49be40aa7e64p-968, 0},                  // 2^-29.5
    {"log10", 0x1.9dfce8eb20783p-1, 0},                    // 2^-29.4
    {"log10", 0x1.d96a50f58bfadp+982, 0},                  // 2^-29.4
    {"log10", 0x1.5bc00cb33d336p-1, 0},                    // 2^-29.3
    {"atan2", 0x1.61cbce5d1873ep-2, 0x1.68607848f02e6p+0}, // 2^-36.0
    {"atan2", 0x1.13f73645a5545p-8, 0x1.4a28f44f71f17p+2}, // 2^-33.4
    {"atan2", 0x1.8ff064c670548p-3, 0x1.407b917053ca3p+2}, // 2^-33.3
    {"atan2", 0x1.d8dd3316c3985p+1, 0x1.5d153032c9489p+1}, // 2^-33.2
    {"atan2", 0x1.54debde38b5bfp+3, 0x1.2c148453792dfp-3}, // 2^-33.2
    {"atan2", 0x1.65e070a18587bp-8, 0x1.78ee16345838dp+3}, // 2^-32.1
    {"atan2", 0x1.169334e365ecfp+6, 0x1.8d0f651f0e4afp-6}, // 2^-32.0
    {"atan2", 0x1.13ab9ed1b7bd9p+7, 0x1.3400924e8137dp+1}, // 2^-32.0
    {"atan2", 0x1.d0c3397b33c34p+9, 0x1.956d2895b9d79p+1}, // 2^-31.8
    {"atan2", 0x1.df4e7d2ca56fdp-3, 0x1.0205f86e3adafp-6}, // 2^-31.1
    {"atan2", 0x1.694fea7f6d455p+0, 0x1.2755e2a5f7358p-4}, // 2^-30.8
    {"atan2", 0x1.90c8f413fda1bp-2, 0x1.502a4482b9e12p-4}, // 2^-30.5
    {"atan2", 0x1.3758131c54ef6p+6, 0x1.b5b519ecca21ap-3}, // 2^-30.5
    {"atan2", 0x1.c71d02d3a366fp-6, 0x1.6bba154c5db2bp-3}, // 2^-30.5
    {"pow", 0x1.a7e207b28392fp+0, 0x1.c06500f82e303p-5},   // 2^-34.7
    {"pow", 0x1.e6eae4a428e6p-3, 0x1.f747c4aa2c0b1p+1},    // 2^-34.4
    {"pow", 0x1.fc209236e4ab5p-1, 0x1.0fe24181944c9p-5},   // 2^-32.8
    {"pow", 0x1.605981b322d7dp-6, 0x1.78c0079f6435p-5},    // 2^-32.5
    {"pow", 0x1.92f05bd122b79p-2, 0x1.30b788b925bf9p-1},   // 2^-32.1
    {"pow", 0x1.bd22096c4154dp-2, 0x1.94b7bf3019b1dp-1},   // 2^-32.1
    {"pow", 0x1.051094a8af57p-1, 0x1.155bea236edfcp-6},    // 2^-32.1
    {"pow", 0x1.b779b7b666ed4p+5, 0x1.99f63500efa53p-6},   // 2^-31.7
    {"pow", 0x1.9f434e2a24463p-6, 0x1.06778bc35dd07p+2},   // 2^-31.5
    {"pow", 0x1.b751fb29c2a9ap+3, 0x1.789da050eb0fep+1},   // 2^-31.3
    {"pow", 0x1.223558d2ba056p+0, 0x1.fdecf1b0f3644p-3},   // 2^-31.2
    {"pow", 0x1.ad9462fa3164ep-1, 0x1.e6cb165880f7bp-1},   // 2^-31.2
    {"pow", 0x1.575d4dcf5244p-1, 0x1.d476fefcd7072p+1},    // 2^-31.0
    {"pow", 0x1.70e5648ffd8b1p-1, 0x1.bd866d63a2c2dp+0},   // 2^-30.9
};

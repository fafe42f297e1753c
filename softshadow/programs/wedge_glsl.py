"""The GLSL of the programs in `wedge`: one fragment shader, with parts for the light's shape.

Mesa rearranges long sums and products. Where a sum has a constant, or a product four factors, their order here is the
one that it leaves alone.
"""

from softshadow.programs.window_lookup import TRIPLE

FRAGMENT = f"""#version 120
uniform sampler2D positions;
uniform sampler2D edges;
uniform float edgeRow;  // height of a texel
uniform vec3 axisU;     // rectangle and disc: the light is where the products with these are from -1 to 1
uniform vec3 axisV;
uniform vec3 normal;
uniform float radius;   // of a sphere
varying vec3 window;
varying vec4 texCoord;
{TRIPLE}

float along(vec3 a, vec3 b)
{{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}}

void clip(float start, float end, inout float first, inout float last)  // off where a linear function is negative
{{
    float zero = start / (start - end);
    if (start < 0.0)
        first = end < 0.0 ? 2.0 : (zero > first ? zero : first);
    if (end < 0.0)
        last = zero < last ? zero : last;
}}

OUTLINE

void main()
{{
    vec4 stored = texture2D(positions, window.st / window.p);
    vec3 point = stored.rgb;
    vec3 start = texture2D(edges, texCoord.st).rgb;
    vec3 end = texture2D(edges, texCoord.st + vec2(0.0, edgeRow)).rgb;
    vec3 u, v, n;
    float height;
    FRAME

    float x0 = along(n, start), x1 = along(n, end);
    float pointU = along(u, point), pointV = along(v, point);
    float u0 = along(u, start) * height - pointU * x0, u1 = along(u, end) * height - pointU * x1;
    float v0 = along(v, start) * height - pointV * x0, v1 = along(v, end) * height - pointV * x1;
    float w0 = height - x0, w1 = height - x1;
    SHARE
    bool inside = triple(start, end, point) < 0.0;
    gl_FragColor = vec4(
        inside ? 0.0 : share, inside ? share : 0.0, meets ? 1.0 : 0.0, inside ? -share : share);
}}
"""

FLAT_FRAME = """
    u = axisU;
    v = axisV;
    n = normal;
    height = along(n, point);
    if (height < 0.0) {
        n = -n;
        height = -height;
    }"""

SPHERE_FRAME = """
    float squared = along(point, point);
    height = sqrt(squared);
    n = point / height;
    float outline = squared - radius * radius;
    float scale = sqrt(outline > 0.0 ? outline : 0.0) / (radius * height);
    vec3 c = abs(n.x) < 0.6 ? vec3(0.0, -n.z, n.y) : vec3(n.z, 0.0, -n.x);
    u = c * (scale / sqrt(along(c, c)));
    v = vec3(n.y * u.z - n.z * u.y, n.z * u.x - n.x * u.z, n.x * u.y - n.y * u.x);
    height = outline > 0.0 ? height : 0.0;"""

SEGMENT_FRAME = """
    float share0 = along(axisU, point) / along(axisU, axisU);
    n = point - share0 * axisU;
    height = sqrt(along(n, n));
    n = n / height;
    u = axisU;
    v = vec3(n.y * u.z - n.z * u.y, n.z * u.x - n.x * u.z, n.x * u.y - n.y * u.x);"""

SHARE_OF_AREA = """
    float first = 0.0, last = 1.0;
    clip(x0, x1, first, last);
    clip(w0 - u0, w1 - u1, first, last);
    clip(w0 + u0, w1 + u1, first, last);
    clip(w0 - v0, w1 - v1, first, last);
    clip(w0 + v0, w1 + v1, first, last);
    float pw = w0 + first * (w1 - w0);
    float qw = last < 1.0 ? w0 + last * (w1 - w0) : w1;
    vec2 p = vec2(u0 + first * (u1 - u0), v0 + first * (v1 - v0)) / pw;
    vec2 q = vec2(last < 1.0 ? u0 + last * (u1 - u0) : u1, last < 1.0 ? v0 + last * (v1 - v0) : v1) / qw;
    bool meets = stored.a > 0.0 && height > 0.0 && first < last && pw > 0.0 && qw > 0.0;
    float share = shareBeyond(p, q, meets);
    share = meets && share > 0.0 ? share : 0.0;"""

SHARE_OF_SEGMENT = """
    float near0 = abs(v1), near1 = abs(v0);  // where the edge crosses v = 0 is the mean of its ends with these weights
    float pu = abs(near0 * u0 + near1 * u1), pw = near0 * w0 + near1 * w1, px = near0 * x0 + near1 * x1;
    bool meets = stored.a > 0.0 && height > 0.0 && (v0 < 0.0) != (v1 < 0.0) && px >= 0.0 && pu < pw;
    float share = meets ? 0.5 - 0.5 * (pu / pw) : 0.0;"""

SQUARE_OUTLINE = """
float squareAngle(vec2 p)  // length along the square's outline to the direction of a point
{
    float low = p.x < 0.0 ? 4.0 : 0.0;
    float high = p.y < 0.0 ? 6.0 : 2.0;
    float ends = p.x == 0.0 ? 0.0 : low + p.y / p.x;
    return abs(p.x) < abs(p.y) ? high - p.x / p.y : ends;
}

float shareBeyond(vec2 p, vec2 q, inout bool meets)
{
    float between = abs(squareAngle(p) - squareAngle(q));
    float sector = between > 4.0 ? 8.0 - between : between;
    return (sector - abs(p.x * q.y - p.y * q.x)) / 8.0;
}"""

ROUND_OUTLINE = """
float angle(float sine, float cosine)
{
    float size = abs(cosine);
    float larger = sine > size ? sine : size;
    float x = (sine > size ? size : sine) / (larger > 1e-30 ? larger : 1e-30);
    float y = x * x;
    float sum = 0.0028662257;
    sum = sum * y + -0.0161657367;
    sum = sum * y + 0.0429096138;
    sum = sum * y + -0.0752896400;
    sum = sum * y + 0.1065626393;
    sum = sum * y + -0.1420889944;
    sum = sum * y + 0.1999355085;
    sum = sum * y + -0.3333314528;
    float turn = x + x * (y * sum);
    turn = sine > size ? 1.57079632679 - turn : turn;
    return cosine < 0.0 ? 3.14159265359 - turn : turn;
}

float shareBeyond(vec2 p, vec2 q, inout bool meets)
{
    float du = q.x - p.x, dv = q.y - p.y;
    float squared = du * du + dv * dv;
    float middle = -(p.x * du + p.y * dv) / squared;
    float radicand = middle * middle - ((p.x * p.x - 1.0) + p.y * p.y) / squared;
    float root = sqrt(radicand > 0.0 ? radicand : 0.0);
    float first = middle - root > 0.0 ? middle - root : 0.0;
    float last = middle + root;
    vec2 r = vec2(p.x + first * du, p.y + first * dv);
    vec2 s = vec2(last < 1.0 ? p.x + last * du : q.x, last < 1.0 ? p.y + last * dv : q.y);
    meets = meets && radicand > 0.0 && first < (last < 1.0 ? last : 1.0);
    float triangle = abs(r.x * s.y - r.y * s.x);
    return (angle(triangle, r.x * s.x + r.y * s.y) - triangle) * 0.159154943092;
}"""

VISIBILITY_FRAGMENT = """#version 120
uniform sampler2D coverage;
uniform vec3 axis;      // of a spot light's cone
uniform float squared;  // cosine of its angle; -1 for other lights
varying vec3 window;
varying vec4 texCoord;

void main()
{
    float visible = 1.0 - texture2D(coverage, window.st / window.p).a;
    visible = visible > 0.0 ? (visible < 1.0 ? visible : 1.0) : 0.0;
    vec3 p = texCoord.stp;
    float forward = p.x * axis.x + p.y * axis.y + p.z * axis.z;
    bool beside = forward < 0.0 || forward * forward < squared * (p.x * p.x + p.y * p.y + p.z * p.z);
    gl_FragColor = vec4(squared >= 0.0 && beside ? 0.0 : visible);
}
"""

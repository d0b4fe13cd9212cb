// harmonics(x, y) = sum(j in 1..8, sin(j x)/j) - y | value
fn harmonics(x: f32, y: f32) -> f32 {
    var sum = 0.0;
    for (var j = 1.0; j <= 8.0; j += 1.0) {
        sum += sin(j * x) / j;
    }
    return sum - y;
}

# refuses-no-number[two-faults-A-nan]-structure: an answer about no numbers.
#
# How it is compared: No answer is right. The function raises an error or answers nothing. It must be refused.
#
# Made by faultspace 0.1.0: faultspace audit --reproduce 'refuses-no-number[two-faults-A-nan]-structure'
# --language julia

using LinearAlgebra

failed = false
function told(what, got, expected, off, bound)
    wrong = any(.!(off .<= bound))
    global failed = failed || wrong
    println(what, ": ", wrong ? "WRONG" : "right")
    println("  got      ", got, "\n  expected ", expected)
    println("  off by ", maximum(off), ", largest ratio to the bound ", maximum(off ./ max.(bound, floatmin())))
end
function nearest(got, expected)  # in the order of those of expected that they are nearest to
    left = collect(ComplexF64, got)
    return length(left) == length(expected) ? [splice!(left, argmin(abs.(left .- z))) for z in expected] : left
end
basis(M) = (F = svd(M / max(mapreduce(abs, max, M; init = 0.0), floatmin())); F.U[:, F.S .> 1e-12 * reduce(max, F.S; init = 0.0)])
angle_of(P, Q) = size(P) == size(Q) ? opnorm(P - Q * (Q' * P)) : 1.0
sine(got, expected) = angle_of(basis(got), basis(expected))  # of the largest angle, 1 for unlike dimensions
matrix(x) = x isa AbstractMatrix ? x : reshape(collect(x), :, 1)
field(answer, name) = answer isa AbstractDict ? answer[String(name)] : getproperty(answer, name)
function stacked(first, C, A, B, rows)
    got = first
    while size(got, 1) < rows
        got = [got; C * B]; B = A * B
    end
    return got
end
seen(row, off) = norm(sum(off[k:end-size(row, 1)+k, :] * row[k, :] for k in axes(row, 1)))
# -- how MatrixPencils.jl: spzeros, sprank is called
haskey(ENV, "MATRIX_PENCILS") && push!(LOAD_PATH, ENV["MATRIX_PENCILS"])
using LinearAlgebra, MatrixPencils

# The pencil [A - lambda I, F; C, G], tolerances by default. Its normal rank is that of the transfer function and n; an infinite elementary
# divisor of order k is an infinite zero of order k - 1, and `orders` has those above 0.
function structure(A, F, C, G)
    values, orders, _ = spzeros(A, I, F, C, G)
    rank = sprank(A, I, F, C, G) - size(A, 1)
    return (normal_rank = rank, finite_zeros = complex(filter(!isinf, values)),
            infinite_zero_orders = [zeros(Int, max(rank - length(orders), 0)); orders], left_invertible = rank == size(G, 2))
end


# -- the question
A = reshape([
    0.1875 0.3125 -0.75
    -0.5625 NaN 0.5
    0.0 0.0 0.0625
], 3, 3)
F = reshape([
    -2.6666666666666665 -1.6666666666666667
    2.6666666666666665 -1.6666666666666667
    2.0 0.3333333333333333
], 3, 2)
C = reshape([
    0.2 -1.6 -1.6
    1.4 -0.4 0.4
    0.2 0.8 -1.4
], 3, 3)
G = reshape([
    -1.0 1.2857142857142858
    -1.2857142857142858 -0.8571428571428571
    0.42857142857142855 0.7142857142857143
], 3, 2)

answer = try structure(A, F, C, G) catch problem; println("refused: ", problem); nothing end
if answer === nothing println("right: there is nothing to answer"); exit(0) end

println("WRONG: answered where no answer can be right\n", answer)
failed = true

exit(failed ? 1 : 0)

; Visiting people and greeting them, each in their own way.
;
; This file says what comity_domain/visit_domain.py builds; a test keeps the two equal.
; Costs are whole centimetres of walking, or what is worth as much: a disliked option costs
; 100 * weight * -ln(desirability), with the weight in metres and the desirability in [0, 1].

(define (domain visit-domain)
  (:requirements :strips :typing :negative-preconditions :action-costs)

  (:types
    robot place side modality gesture - object
    user - place)                      ; people are places to be at: the robot stands on one of their sides

  (:predicates
    ; what changes
    (at ?r - robot ?p - place ?s - side)
    (docked ?r - robot ?p - place)     ; near enough to a person, and turned to them, to greet
    (free ?r - robot)                  ; owes nobody a greeting, so it may leave
    (greeted ?u - user)

    ; what the person and the map allow
    (reachable ?u - user ?s - side)    ; the person accepts this side, and some route leads there
    (permitted ?u - user ?m - modality ?g - gesture)
    (route ?from - place ?from_side - side ?u - user ?s - side))

  (:functions
    ; one function per action, everything fused into it
    (travel_cost ?from - place ?from_side - side ?u - user ?s - side)    ; the route, and the dislike of the side
    (greet_cost ?u - user ?m - modality ?g - gesture)                    ; the dislike of the greeting

    ; the parameters bound when the plan is made, rounded; the plan itself carries them with full precision
    (distance_mm ?u - user)
    (speed_mm_s ?u - user)
    (direction_mdeg ?u - user ?s - side)    ; without its sign: positive on the left, negative on the right

    (total-cost))

  ; Go to a person and dock at their conversational distance, from one of their sides.
  ; Binds the distance, the direction and the speed.
  (:action Reach_user
    :parameters (?r - robot ?u - user ?s - side ?from - place ?from_side - side)
    :precondition (and
      (free ?r)
      (at ?r ?from ?from_side)
      (not (greeted ?u))
      (reachable ?u ?s)
      (route ?from ?from_side ?u ?s))
    :effect (and
      (at ?r ?u ?s)
      (docked ?r ?u)
      (not (at ?r ?from ?from_side))
      (not (docked ?r ?from))
      (not (free ?r))                  ; whoever is approached is greeted before the robot goes on
      (increase (total-cost) (travel_cost ?from ?from_side ?u ?s))))

  ; Greet the person the robot is docked to: in words, with a gesture, or both. Words alone take the gesture `none`.
  (:action Greet_person
    :parameters (?r - robot ?u - user ?m - modality ?g - gesture)
    :precondition (and
      (docked ?r ?u)
      (permitted ?u ?m ?g))
    :effect (and
      (greeted ?u)
      (free ?r)
      (increase (total-cost) (greet_cost ?u ?m ?g)))))
